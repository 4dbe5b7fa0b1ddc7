// SPDX-License-Identifier: MIT
#include <framework/app/dump.h>

#include <framework/graph/header.h>
#include <framework/graph/npy.h>
#include <framework/graph/struct_layout.h>
#include <framework/image/exr.h>

#include <array>

namespace lodestir {

void dumpPort(const Graph& graph, const Runner& runner, const Source& source, const Path& path) {
    const Port& port = graph.port(source);
    if (port.type.kind == PortType::Kind::image) {
        writeExr(path.string() + ".exr", runner.readImage(source), {.attributes = {{"lodestir", graph.resolved().dump(-1)}}});
        return;
    }
    const Plugin& plugin = *graph.nodes[std::size_t(source.node)].plugin;
    const std::vector<std::byte> bytes = runner.readBytes(source);
    const std::array<std::size_t, 1> shape{bytes.size() / port.type.size};
    writeNpy(path.string() + ".npy", bytes, structFields(port.type.name, Path(port.type.header), includeFolders(plugin), port.type.size), shape);
}

}  // namespace lodestir
