// SPDX-License-Identifier: MIT
// Writes pass.glsl. All memory is reached through device addresses in one block per pass; the block is found by a push constant.
#include <framework/graph/header.h>
#include <framework/shaders/base/frame.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <iterator>
#include <set>

namespace lodestir {
namespace {

std::string capitalised(std::string_view name) {
    std::string text(name);
    text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

/// A choice's name as the end of an identifier: "ray query" -> ray_query.
std::string identifier(std::string_view name) {
    std::string text(name);
    std::ranges::replace_if(
        text, [](unsigned char c) { return !std::isalnum(c); }, '_');
    return text;
}

/// Texts are seen by the pass alone.
bool isText(const Parameter& parameter) { return std::holds_alternative<std::string>(parameter.initial); }

std::string typeOf(const Parameter& parameter) {
    if (std::holds_alternative<bool>(parameter.initial)) return "bool";
    return std::holds_alternative<float>(parameter.initial) ? "float" : "int";
}

std::string literal(const Value& value) {
    if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const int* number = std::get_if<int>(&value)) return fmt::format("{}", *number);
    return fmt::format("{:#}", std::get<float>(value));
}

bool isWritable(const Port& port) { return !port.isInput() && port.type.kind != PortType::Kind::handle; }

/// Writes the parts of the file one after the other into one text.
class HeaderWriter {
public:
    HeaderWriter(const Pass& pass, std::span<const PortBinding> bindings) : pass_(pass), bindings_(bindings) {}

    std::string write(std::string_view owner) {
        line("// pass.glsl of {}: its ports and parameters as the shader sees them. Written from the declaration.", owner);
        line("#extension GL_EXT_null_initializer : enable");
        line("#include \"base/frame.h\"");
        line("#include \"base/texel.glsl\"");
        writeIncludes();
        writeConstants();
        writeBlock();
        line("\n#include \"base/invocation.glsl\"");
        writeMemoryTypes();
        for (std::size_t i = 0; i < pass_.ports.size(); ++i) writePort(i);
        return std::move(text_);
    }

private:
    template <class... A> void line(fmt::format_string<A...> format, A&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<A>(arguments)...);
        text_ += '\n';
    }

    void writeIncludes() {
        std::set<std::string_view> written;
        for (const Port* port : pass_.ports) {
            if (!port->type.header.empty() && written.insert(port->type.header).second) line("#include \"{}\"", port->type.header);
        }
    }

    void writeConstants() {
        const BlockLayout layout = blockLayout(pass_);
        for (std::size_t i = 0; i < pass_.parameters.size(); ++i) {
            const Parameter& parameter = *pass_.parameters[i];
            if (!layout.constants[i]) continue;
            line("\n// {} ({})", parameter.doc, parameter.typeText());
            line("layout(constant_id = {}) const {} {} = {};", *layout.constants[i], typeOf(parameter), parameter.name,
                 literal(parameter.initial));
        }
        for (const Parameter* parameter : pass_.parameters) {
            if (!parameter->isChoice()) continue;
            line("\n// choices of {}", parameter->name);
            for (std::size_t k = 0; k < parameter->choices.size(); ++k)
                line("const int {}_{} = {};", parameter->name, identifier(parameter->choices[k]), k);
        }
    }

    /// How the shader reads the port. An output that has the name of an input is read as madeName: the plain name is the input.
    std::string readName(const Port& port) const {
        const bool shared = !port.isInput() && std::ranges::count(pass_.ports, port.name, &Port::name) == 2;
        return shared ? "made" + capitalised(port.identifier()) : port.identifier();
    }

    void writeBlock() {
        const bool hasUniforms = std::ranges::any_of(pass_.parameters, [](const Parameter* p) { return !p->constant && !isText(*p); });
        if (hasUniforms) {
            line("\nstruct Params {{");
            for (const Parameter* parameter : pass_.parameters) {
                if (parameter->constant || isText(*parameter)) continue;
                line("    {} {};  // {} ({})", typeOf(*parameter), parameter->name, parameter->doc, parameter->typeText());
            }
            line("}};");
        }
        line("\nlayout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PassBlock {{");
        line("    FrameInfo frame;");
        for (const Port* port : pass_.ports) line("    PortRecord {};", readName(*port));
        if (hasUniforms) line("    Params params;");
        line("#ifdef PROBING\n    uint64_t probeMemory;  // ProbeMemory\n#endif");
        line("}};");
        line("layout(push_constant, scalar) uniform PushConstants {{ Push push; }};");
        line("PassBlock passBlock() {{ return PassBlock(push.block); }}");
        if (hasUniforms) line("#define params passBlock().params");
    }

    /// One address type for each struct that is only read, however many ports carry it. What the pass makes has types of its own by port, so that
    /// a shader that reads one port and writes another is known not to write what it reads.
    void writeMemoryTypes() {
        std::set<std::pair<PortType::Kind, std::string_view>> written;
        for (const Port* port : pass_.ports) {
            const PortType& type = port->type;
            if (type.kind == PortType::Kind::handle) {
                if (written.emplace(type.kind, type.name).second)
                    line("\nlayout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer {}Memory {{ {} value; }};",
                         capitalised(type.name), type.name);
            } else if (type.kind == PortType::Kind::buffer && port->isInput()) {
                if (written.emplace(type.kind, type.name).second)
                    line("\nlayout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer {} {{ {} at[]; }};",
                         elementsOf(*port), type.name);
            } else if (type.kind == PortType::Kind::buffer) {
                line("\nlayout(buffer_reference, scalar, buffer_reference_align = 16) buffer {} {{ {} at[]; }};", elementsOf(*port), type.name);
            }
        }
    }

    /// The address type of a buffer port.
    std::string elementsOf(const Port& port) const { return port.isInput() ? "In" + capitalised(port.type.name) : "Out" + capitalised(readName(port)); }

    void writePort(std::size_t i) {
        const Port& port = *pass_.ports[i];
        const bool bound = bindings_[i].bound;
        const Format format = port.isInput() ? bindings_[i].format : port.format;
        const std::string kind = port.type.kind == PortType::Kind::image && bound ? std::string(factsOf(format).name) : port.type.text();
        line("\n// {} ({}{})", port.doc, kind, bound ? "" : port.isInput() ? ", unwired" : ", not made");
        if (!port.isInput() && !bound) return line("void store{}(ivec2 p, {} value) {{}}", capitalised(port.identifier()), factsOf(format).glsl);
        // Of those that are always wired, too: files that several passes share ask, and GLSL takes what is not defined for 0.
        if (port.isInput() && startsWire(port)) line("#define HAS_{} {}", port.wire(), bound ? 1 : 0);
        switch (port.type.kind) {
        case PortType::Kind::image: bound ? writeImage(i, port, format) : writeNoImage(port); break;
        case PortType::Kind::buffer: bound ? writeBuffer(i, port) : writeNoBuffer(port); break;
        case PortType::Kind::handle: writeHandle(port, bound); break;
        }
    }

    static bool startsWire(const Port& port) { return !port.bundle || &port == &port.bundle->members.front(); }

    void writeImage(std::size_t i, const Port& port, Format format) {
        const FormatFacts& facts = factsOf(format);
        const std::string stored = capitalised(facts.name);
        const std::string name = readName(port);
        line("ivec2 {}Size() {{ return ivec2(passBlock().{}.size); }}", name, name);
        line("{} {}(ivec2 p) {{", facts.glsl, name);
        line("    const PortRecord port = passBlock().{};", name);
        line("    if (isOutside({}u, p, port.size)) return {}(0);", i, facts.glsl);
        line("    return decode{}({}{}(port.address).at[texelIndex(p, port.size)]);", stored, port.isInput() ? "In" : "Out", stored);
        line("}}");
        if (port.isInput()) line("vec4 {}Rgba(ivec2 p) {{ return asRgba({}(p)); }}", name, name);
        if (!isWritable(port)) return;
        line("void store{}(ivec2 p, {} value) {{", capitalised(port.identifier()), facts.glsl);
        line("    const PortRecord port = passBlock().{};", name);
        line("    if (isOutside({}u, p, port.size)) return;", i);
        line("    Out{}(port.address).at[texelIndex(p, port.size)] = encode{}(value);", stored, stored);
        line("}}");
    }

    void writeNoImage(const Port& port) {
        line("ivec2 {}Size() {{ return ivec2(0); }}", port.name);
        line("vec4 {}(ivec2 p) {{ return vec4(0); }}", port.name);
        line("vec4 {}Rgba(ivec2 p) {{ return vec4(0); }}", port.name);
    }

    void writeBuffer(std::size_t i, const Port& port) {
        const std::string memory = elementsOf(port);
        const std::string name = readName(port);
        line("uint {}Count() {{ return passBlock().{}.size.x; }}", name, name);
        line("{} {}(uint i) {{", port.type.name, name);
        line("    const PortRecord port = passBlock().{};", name);
        line("    {} nothing = {{}};", port.type.name);
        line("    if (isOutside({}u, ivec2(i, 0), uvec2(port.size.x, 1))) return nothing;", i);
        line("    return {}(port.address).at[i];", memory);
        line("}}");
        if (!isWritable(port)) return;
        line("void store{}(uint i, {} value) {{", capitalised(port.identifier()), port.type.name);
        line("    const PortRecord port = passBlock().{};", name);
        line("    if (isOutside({}u, ivec2(i, 0), uvec2(port.size.x, 1))) return;", i);
        line("    {}(port.address).at[i] = value;", memory);
        line("}}");
        if (port.type.name != "uint") return;
        line("uint add{}(uint i, uint value) {{", capitalised(port.identifier()));
        line("    const PortRecord port = passBlock().{};", name);
        line("    if (isOutside({}u, ivec2(i, 0), uvec2(port.size.x, 1))) return 0u;", i);
        line("    return atomicAdd({}(port.address).at[i], value);", memory);
        line("}}");
    }

    void writeNoBuffer(const Port& port) {
        line("uint {}Count() {{ return 0u; }}", port.identifier());
        line("{} {}(uint i) {{ {} nothing = {{}}; return nothing; }}", port.type.name, port.identifier(), port.type.name);
    }

    void writeHandle(const Port& port, bool bound) {
        if (bound) {
            line("{} {}() {{ return {}Memory(passBlock().{}.address).value; }}", port.type.name, readName(port), capitalised(port.type.name),
                 readName(port));
        } else {
            // Not zero: a struct that holds addresses can't be.
            line("{} {}() {{ {} nothing; return nothing; }}", port.type.name, port.name, port.type.name);
        }
    }

    const Pass& pass_;
    std::span<const PortBinding> bindings_;
    std::string text_;
};

}  // namespace

std::vector<PortBinding> bindingsOf(const Graph& graph, const Plan& plan, int node) {
    const GraphNode& n = graph.nodes[std::size_t(node)];
    std::vector<PortBinding> bindings;
    for (std::size_t i = 0; i < n.inputs.size(); ++i) {
        const Port& port = *n.pass->ports[i];
        const bool bound = port.isInput() ? n.inputs[i].has_value() : !port.optional || plan.resourceOf(node, int(i)) >= 0;
        bindings.push_back({bound, bound && port.isInput() ? graph.port(*n.inputs[i]).format : port.format});
    }
    return bindings;
}

std::string passHeader(const Pass& pass, std::string_view owner, std::span<const PortBinding> bindings) {
    return HeaderWriter(pass, bindings).write(owner);
}

BlockLayout blockLayout(const Pass& pass) {
    constexpr std::size_t word = sizeof(std::uint32_t);
    BlockLayout layout;
    layout.bytes = sizeof(FrameInfo);
    for (std::size_t i = 0; i < pass.ports.size(); ++i) {
        layout.ports.push_back(layout.bytes);
        layout.bytes += sizeof(PortRecord);
    }
    for (std::size_t i = 0; i < pass.parameters.size(); ++i) {
        const Parameter& parameter = *pass.parameters[i];
        layout.parameters.emplace_back();
        layout.constants.emplace_back();
        if (isText(parameter)) continue;
        if (parameter.constant) {
            layout.constants.back() = std::uint32_t(i);
        } else {
            layout.parameters.back() = layout.bytes;
            layout.bytes += word;
        }
    }
    layout.bytes = (layout.bytes + alignof(FrameInfo) - 1) / alignof(FrameInfo) * alignof(FrameInfo);
    return layout;
}

std::uint32_t bitsOf(const Parameter& parameter) {
    if (const bool* flag = std::get_if<bool>(&parameter.value)) return *flag ? 1 : 0;
    if (const int* number = std::get_if<int>(&parameter.value)) return std::bit_cast<std::uint32_t>(*number);
    return std::bit_cast<std::uint32_t>(std::get<float>(parameter.value));
}

void writeParameters(const Pass& pass, const BlockLayout& layout, std::span<std::byte> block) {
    for (std::size_t i = 0; i < pass.parameters.size(); ++i) {
        if (!layout.parameters[i]) continue;
        const std::uint32_t bits = bitsOf(*pass.parameters[i]);
        std::memcpy(block.subspan(*layout.parameters[i], sizeof bits).data(), &bits, sizeof bits);
    }
}

glm::uvec2 groupCount(glm::uvec2 extent) {
    constexpr std::uint32_t tile = 8, row = 64;  // base/invocation.glsl
    if (extent.y == 1) return {(extent.x + row - 1) / row, 1};
    return {(extent.x + tile - 1) / tile, (extent.y + tile - 1) / tile};
}

}  // namespace lodestir
