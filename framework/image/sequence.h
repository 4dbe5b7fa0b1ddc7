// SPDX-License-Identifier: MIT
// Image files that are the frames of one sequence: their names differ in a number only.
#pragma once
#include <framework/core/files.h>

#include <map>

namespace lodestir {

/// Whether a path stands for a sequence: "out/display.%d.exr", %d being the number of the frame, in the file's name.
LODESTIR_API bool isSequence(const Path& path);

/// The files of a sequence by number, as they lie in its folder. Throws Error when there is none, when %d stands twice, or when two names
/// mean one number (7 and 07).
LODESTIR_API std::map<int, Path> sequenceFiles(const Path& path);

}  // namespace lodestir
