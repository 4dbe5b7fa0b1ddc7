// SPDX-License-Identifier: MIT
// Ports enter themselves into their pass; facts of texel formats.
#include <framework/pass/bundle.h>
#include <framework/pass/pass.h>

#include <array>
#include <cctype>

namespace lodestir {

const FormatFacts& factsOf(Format format) {
    static constexpr std::array<FormatFacts, 8> facts{{
        {"r16f", "float", 2, 1},
        {"rg16f", "vec2", 4, 2},
        {"rgba16f", "vec4", 8, 4},
        {"r32f", "float", 4, 1},
        {"rg32f", "vec2", 8, 2},
        {"rgba32f", "vec4", 16, 4},
        {"rgba8", "vec4", 4, 4},
        {"r32ui", "uint", 4, 1},
    }};
    return facts[static_cast<std::size_t>(format)];
}

std::string PortType::text() const { return kind == Kind::buffer ? "Buffer<" + std::string(name) + ">" : std::string(name); }

std::string_view Port::wire() const { return bundle ? bundle->name : name; }

std::string Port::identifier() const {
    std::string text(name);
    for (std::size_t dot = 0; (dot = text.find('.')) != text.npos;) {
        text.erase(dot, 1);
        if (dot < text.size()) text[dot] = char(std::toupper(static_cast<unsigned char>(text[dot])));
    }
    return text;
}

Port::Port(Pass* pass, std::string_view name_, std::string_view doc_, PortType type_, Role role_, Shape shape, bool optional_)
    : name(name_),
      doc(doc_),
      type(type_),
      role(role_),
      optional(optional_),
      format(shape.format),
      extent(shape.extent),
      count(shape.count) {
    pass->ports.push_back(this);
}

}  // namespace lodestir
