// SPDX-License-Identifier: MIT
#include <framework/core/file_kind.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace lodestir {
namespace {

struct Kind {
    const char* name;
    const char* use;  ///< where such a file belongs
};

Kind describe(FileKind kind) {
    constexpr std::array<Kind, 5> kinds{{{"a graph", "lodestir run GRAPH"},
                                         {"a scene", "give it as --scene to a graph: lodestir run GRAPH --scene SCENE"},
                                         {"a study", "lodestir study STUDY"},
                                         {"what a run wrote", "the graph that it ran is under its key \"graph\""},
                                         {"a model", "models are named .gltf or .glb, and are given to a graph as --scene"}}};
    return kinds[std::size_t(kind)];
}

[[noreturn]] void refuse(const std::string& file, FileKind found, FileKind wanted) {
    throw Error(Where{file}, std::string("is ") + describe(found).name + ", not " + describe(wanted).name, describe(found).use);
}

}  // namespace

FileKind kindOf(const Json& file) {
    if (file.find("asset")) return FileKind::model;
    if (file.find("passes")) return FileKind::graph;
    if (file.find("techniques")) return FileKind::study;
    if (file.find("models")) return FileKind::scene;
    if (file.find("frames") && file.find("graph")) return FileKind::run;
    return FileKind::unknown;
}

void expectKind(const Json& file, FileKind wanted) {
    const FileKind found = kindOf(file);
    if (found != FileKind::unknown && found != wanted) refuse(file.where().file, found, wanted);
}

void expectNoModel(const std::filesystem::path& file, FileKind wanted) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (extension == ".gltf" || extension == ".glb") refuse(file.string(), FileKind::model, wanted);
}

}  // namespace lodestir
