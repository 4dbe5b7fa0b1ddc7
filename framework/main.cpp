// SPDX-License-Identifier: MIT
// The program: a command line becomes a command.
#include <framework/app/program.h>

int main(int argc, char** argv) { return lodestir::runProgram(argc, argv); }
