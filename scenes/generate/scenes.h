// SPDX-License-Identifier: MIT
// The scenes that generate_scenes can make; each writes its .glb files into the given folder.
#pragma once

#include <filesystem>

namespace lodestir::generate {

void writeCornell(const std::filesystem::path& folder);
void writeMaterialSpheres(const std::filesystem::path& folder);
void writeInterior(const std::filesystem::path& folder);
void writeRock(const std::filesystem::path& folder);
void writeEnsembleRooms(const std::filesystem::path& folder);
void writeEnsembleViews(const std::filesystem::path& folder);
void writeFurnace(const std::filesystem::path& folder);
void writePlane(const std::filesystem::path& folder);
void writeCube(const std::filesystem::path& folder);
void writeChessboard(const std::filesystem::path& folder);

}  // namespace lodestir::generate
