// SPDX-License-Identifier: MIT
// generate_scenes FOLDER [NAME]...: writes the procedural scenes as binary glTF files, all of them or those named.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes.h"

int main(int argc, char** argv) {
    using namespace lodestir::generate;
    struct Scene {
        const char* name;
        void (*write)(const std::filesystem::path&);
    };
    const Scene scenes[] = {{"cornell", writeCornell}, {"material_spheres", writeMaterialSpheres}, {"interior", writeInterior},
                            {"rock", writeRock},       {"ensemble_rooms", writeEnsembleRooms},     {"ensemble_views", writeEnsembleViews},
                            {"furnace", writeFurnace}, {"plane", writePlane},                  {"cube", writeCube},
                            {"chessboard", writeChessboard}};

    if (argc < 2) {
        std::fprintf(stderr, "usage: generate_scenes FOLDER [NAME]...\nnames:");
        for (const Scene& scene : scenes) std::fprintf(stderr, " %s", scene.name);
        std::fprintf(stderr, "\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    const std::vector<std::string> wanted(argv + 2, argv + argc);
    for (const std::string& name : wanted)
        if (std::none_of(std::begin(scenes), std::end(scenes), [&](const Scene& s) { return name == s.name; })) {
            std::fprintf(stderr, "generate_scenes: no scene is called '%s'\n", name.c_str());
            return 2;
        }

    try {
        std::filesystem::create_directories(folder);
        for (const Scene& scene : scenes) {
            if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), scene.name) == wanted.end()) continue;
            const auto start = std::chrono::steady_clock::now();
            scene.write(folder);
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
            std::printf("%s (%.1f s)\n", scene.name, seconds.count());
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "generate_scenes: %s\n", error.what());
        return 1;
    }
    return 0;
}
