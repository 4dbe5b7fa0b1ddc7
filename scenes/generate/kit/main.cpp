// SPDX-License-Identifier: MIT
// generate_NAME FILE: writes a procedural scene as a binary glTF file.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "scene.h"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: %s FILE.glb\n", argv[0]);
        return 2;
    }
    try {
        const std::filesystem::path file = argv[1];
        std::filesystem::create_directories(file.parent_path());
        lodestir::generate::scene().write(file);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
        return 1;
    }
    return 0;
}
