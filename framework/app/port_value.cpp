// SPDX-License-Identifier: MIT
#include <framework/app/port_value.h>

#include <framework/app/probe_tree.h>
#include <framework/graph/plan.h>
#include <framework/graph/struct_layout.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// One value is itself, several are a list.
template <class F> OrderedJson listOf(std::size_t count, const F& value) {
    if (count == 1) return value(0);
    OrderedJson list = OrderedJson::array();
    for (std::size_t i = 0; i < count; ++i) list.push_back(value(i));
    return list;
}

template <class T> T read(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

OrderedJson scalar(const NumberType& type, const std::byte* from) {
    if (type.kind == 'f' && type.bytes == 4) return numberJson(read<float>(from));
    std::uint64_t bits = 0;
    std::memcpy(&bits, from, type.bytes);
    if (type.kind == 'i' && type.bytes == 4) return std::int32_t(bits);
    return bits;
}

OrderedJson structJson(const std::vector<StructField>& fields, const std::byte* from) {
    OrderedJson object = OrderedJson::object();
    for (const StructField& field : fields) {
        const NumberType type = numberType(field.type);
        const auto element = [&](std::size_t i) {
            const std::byte* at = from + field.offset + i * field.size;
            if (type.kind == 0) return structJson(field.members, at);
            return listOf(type.rows * type.columns, [&](std::size_t k) { return scalar(type, at + k * type.bytes); });
        };
        OrderedJson value = listOf(std::max<std::size_t>(field.count, 1), element);
        if (field.name.empty()) return value;
        object[field.name] = std::move(value);
    }
    return object;
}

}  // namespace

std::vector<Source> pixelPorts(const Graph& graph) {
    std::vector<Source> ports;
    for (const PlanStep& step : makePlan(graph, {}, {}).steps) {
        const auto& declared = graph.nodes[std::size_t(step.node)].pass->ports;
        for (std::size_t i = 0; i < declared.size(); ++i) {
            const Port& port = *declared[i];
            const bool kept = port.role == Port::Role::out || port.role == Port::Role::state;
            const bool perPixel = port.type.kind == PortType::Kind::buffer && port.count.kind == Count::Kind::perPixel;
            if (kept && (port.type.kind == PortType::Kind::image || perPixel)) ports.push_back({step.node, int(i), false});
        }
    }
    return ports;
}

OrderedJson pixelValue(Session& session, const Source& source, glm::ivec2 pixel) {
    const Graph& graph = session.graph();
    const Port& port = graph.port(source);
    const glm::ivec2 size = session.runner().size();
    if (port.type.kind == PortType::Kind::image) {
        const ImageData image = session.runner().readImage(source);
        const glm::ivec2 at = pixel * glm::ivec2(image.width, image.height) / size;
        return listOf(std::size_t(image.channels), [&](std::size_t c) { return numberJson(image.at(at.x, at.y, int(c))); });
    }
    const std::vector<std::byte> bytes = session.runner().readBytes(source);
    const std::vector<StructField> fields =
        structFields(port.type.name, Path(port.type.header), includeFolders(*graph.nodes[std::size_t(source.node)].plugin), port.type.size);
    const std::size_t slots = port.count.number, first = (std::size_t(pixel.y) * std::size_t(size.x) + std::size_t(pixel.x)) * slots;
    return listOf(slots, [&](std::size_t i) { return structJson(fields, bytes.data() + (first + i) * port.type.size); });
}

}  // namespace lodestir
