// SPDX-License-Identifier: MIT
#include <framework/app/view/port_info.h>

#include <framework/graph/header.h>
#include <framework/graph/struct_layout.h>

#include <fmt/format.h>

namespace lodestir {
namespace {

/// The fields of a struct that can be looked at, those of its own structs as "outer.inner".
void collectFields(const std::vector<StructField>& fields, const std::string& prefix, std::size_t base, std::size_t stride, std::vector<PortField>& out) {
    for (const StructField& field : fields) {
        const std::string name = prefix + field.name;
        if (const auto layout = layoutOf(field, base, stride)) out.push_back({name, field.type, *layout});
        else if (field.count == 0 && !field.members.empty()) collectFields(field.members, name + ".", base + field.offset, stride, out);
    }
}

}  // namespace

PortInfo describePort(const Graph& graph, const Runner& runner, const Source& source) {
    const Port& port = graph.port(source);
    const glm::uvec2 size = runner.size();
    PortInfo info{.name = graph.nameOf(source), .doc = std::string(port.doc), .text = {}, .source = source, .fields = {}};
    info.runs = runner.plan().resourceOf(source.node, source.port) >= 0;
    info.bytes = bytesOf(graph, source.node, source.port, size);
    if (port.type.kind == PortType::Kind::image) {
        info.extent = sizeOf(graph, source.node, source.port, size);
        info.text = fmt::format("{} {}x{}", factsOf(port.format).name, info.extent.x, info.extent.y);
        info.fields.push_back({"", std::string(factsOf(port.format).name), layoutOf(port.format)});
        return info;
    }
    const std::uint32_t count = countOf(graph, source.node, source.port, size);
    info.text = fmt::format("{}  {} x {} B", port.type.text(), count, port.type.size);
    const std::uint32_t pixels = size.x * size.y;
    if (pixels == 0 || count % pixels != 0 || count / pixels > 4) return info;
    try {  // several elements a pixel lie side by side: the first is shown
        const std::size_t stride = port.type.size * (count / pixels);
        const Plugin& plugin = *graph.nodes[std::size_t(source.node)].plugin;
        collectFields(structFields(port.type.name, Path(port.type.header), includeFolders(plugin), port.type.size), "", 0, stride, info.fields);
        if (!info.fields.empty()) info.extent = size;
    } catch (const Error&) {
        info.fields.clear();  // a struct that only its own shaders understand: named, not shown
    }
    return info;
}

}  // namespace lodestir
