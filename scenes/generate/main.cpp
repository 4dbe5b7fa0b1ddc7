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
    std::vector<const Scene*> scenes;
    for (const Scene* scene = Scene::first; scene; scene = scene->next) scenes.push_back(scene);

    if (argc < 2) {
        std::fprintf(stderr, "usage: generate_scenes FOLDER [NAME]...\nnames:");
        for (const Scene* scene : scenes) std::fprintf(stderr, " %s", scene->name);
        std::fprintf(stderr, "\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    const std::vector<std::string> wanted(argv + 2, argv + argc);
    for (const std::string& name : wanted)
        if (std::ranges::find(scenes, name, &Scene::name) == scenes.end()) {
            std::fprintf(stderr, "generate_scenes: no scene is called '%s'\n", name.c_str());
            return 2;
        }

    try {
        std::filesystem::create_directories(folder);
        for (const Scene* scene : scenes) {
            if (!wanted.empty() && std::ranges::find(wanted, scene->name) == wanted.end()) continue;
            const auto start = std::chrono::steady_clock::now();
            scene->write(folder);
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
            std::printf("%s (%.1f s)\n", scene->name, seconds.count());
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "generate_scenes: %s\n", error.what());
        return 1;
    }
    return 0;
}
