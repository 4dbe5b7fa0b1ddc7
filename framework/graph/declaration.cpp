// SPDX-License-Identifier: MIT
// Checks what a pass declares: names that would not compile in GLSL, shapes that follow nothing, defaults that are not allowed.
#include <framework/graph/header.h>
#include <framework/graph/wire.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace lodestir {
namespace {

/// Keywords of GLSL 4.60 (section 3.6) that are words of small letters, the words it keeps for later, and those of our extensions.
const std::set<std::string_view>& glslWords() {
    static const std::set<std::string_view> words{"active",     "asm",        "atomic_uint",   "attribute", "bool",      "break",
                                                  "buffer",     "bvec2",      "bvec3",         "bvec4",     "case",      "cast",
                                                  "centroid",   "class",      "coherent",      "common",    "const",     "continue",
                                                  "default",    "discard",    "dmat2",         "dmat3",     "dmat4",     "do",
                                                  "double",     "dvec2",      "dvec3",         "dvec4",     "else",      "enum",
                                                  "extern",     "external",   "false",         "filter",    "fixed",     "flat",
                                                  "float",      "for",        "fvec2",         "fvec3",     "fvec4",     "goto",
                                                  "half",       "highp",      "hvec2",         "hvec3",     "hvec4",     "if",
                                                  "in",         "inline",     "inout",         "input",     "int",       "interface",
                                                  "invariant",  "isampler2D", "ivec2",         "ivec3",     "ivec4",     "layout",
                                                  "long",       "lowp",       "mat2",          "mat3",      "mat4",      "mediump",
                                                  "namespace",  "noinline",   "noperspective", "out",       "output",    "partition",
                                                  "patch",      "precise",    "precision",     "public",    "readonly",  "resource",
                                                  "restrict",   "return",     "sample",        "sampler",   "sampler2D", "shared",
                                                  "short",      "sizeof",     "smooth",        "static",    "struct",    "subroutine",
                                                  "superp",     "switch",     "template",      "texture2D", "this",      "true",
                                                  "typedef",    "uint",       "uniform",       "union",     "unsigned",  "using",
                                                  "uvec2",      "uvec3",      "uvec4",         "varying",   "vec2",      "vec3",
                                                  "vec4",       "void",       "volatile",      "while",     "writeonly", "subgroupuniform",
                                                  "nonuniform", "nonprivate", "demote",        "float16_t", "float32_t", "float64_t",
                                                  "int8_t",     "int16_t",    "int32_t",       "int64_t",   "uint8_t",   "uint16_t",
                                                  "uint32_t",   "uint64_t"};
    return words;
}

/// Names that pass.glsl and the files it includes declare themselves.
const std::set<std::string_view>& ownWords() {
    static const std::set<std::string_view> words{
        "main", "push",       "params",    "frame",   "passBlock",    "pixel",      "inside",    "pixelIndex", "argument",   "warming",
        "skip", "frameIndex", "frameSize", "runSeed", "passSalt", "historyValid", "validating", "countRays", "isOutside",  "texelIndex", "asRgba",
        "probeMemory"};
    return words;
}

bool isGlslName(std::string_view name) {
    return !name.empty() && std::islower(static_cast<unsigned char>(name[0])) &&
           std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c); });
}

class DeclarationCheck {
public:
    DeclarationCheck(const Pass& pass, const std::string& type, const Where& where, Problems& problems)
        : pass_(pass), type_(type), where_(where), problems_(problems) {}

    void run() {
        for (const Wire& wire : wiresOf(pass_)) {
            if (sharesName(wire)) continue;
            checkName("port", wire.name());
            if (wire.bundle) checkMembers(*wire.bundle);
        }
        for (const Parameter* parameter : pass_.parameters) checkName("parameter", parameter->name);
        for (const Port* port : pass_.ports) checkGenerated(*port);
        for (const Port* port : pass_.ports) checkShape(*port);
        for (const Parameter* parameter : pass_.parameters) checkParameter(*parameter);
        for (const Pass::Bypass& bypass : pass_.bypasses) checkLink("bypass", bypass);
        for (const Pass::Bypass& over : pass_.overwrites) checkLink("overwriting", over);
    }

private:
    void add(std::string what, std::string hint = {}) { problems_.add(where_, "pass type \"" + type_ + "\": " + what, std::move(hint)); }

    /// An output may have the name of an input of its type, declared before it: what comes in goes out changed.
    bool sharesName(const Wire& wire) const {
        const std::vector<Wire> wires = wiresOf(pass_);
        const auto first = std::ranges::find(wires, wire.name(), &Wire::name);
        return first->first != wire.first && first->port().isInput() && !wire.port().isInput() && first->fits(wire) &&
               std::ranges::count(wires, wire.name(), &Wire::name) == 2;
    }

    void checkName(const char* kind, std::string_view name) {
        const std::string start = fmt::format("{} \"{}\" ", kind, name);
        if (!isGlslName(name)) {
            add(start + "can't be a name in a shader", "start with a small letter, then letters and digits");
        } else if (glslWords().contains(name)) {
            add(start + "is a reserved word of GLSL", "choose another name");
        } else if (ownWords().contains(name)) {
            add(start + "is a name that pass.glsl uses itself", "choose another name");
        } else if (!names_.insert(std::string(name)).second) {
            add(start + "is declared twice", "ports and parameters share one set of names");
        }
    }

    void checkMembers(const BundlePort& bundle) {
        for (const BundlePort::Member& member : bundle.members) {
            const std::string start = fmt::format("member \"{}\" of port \"{}\" ", member.inBundle, bundle.name);
            if (!isGlslName(member.inBundle)) add(start + "can't be a name in a shader", "start with a small letter, then letters and digits");
            else if (!names_.insert(member.identifier()).second) add(fmt::format("{}meets another \"{}\"", start, member.identifier()), "choose another name");
        }
    }

    /// colorSize() of port color would meet a port named colorSize.
    void checkGenerated(const Port& port) {
        if (port.name.empty()) return;
        const std::string name = port.identifier();
        std::string capital = name;
        capital[0] = char(std::toupper(static_cast<unsigned char>(capital[0])));
        std::vector<std::string> made{name + "Size", name + "Count", name + "Rgba", "store" + capital, "add" + capital};
        for (const std::string& text : made) {
            if (names_.contains(text)) add(fmt::format("\"{}\" is what pass.glsl makes of port \"{}\"", text, port.name), "choose another name");
        }
    }

    const Port* find(std::string_view name) const {
        const auto found = std::ranges::find(pass_.ports, name, &Port::wire);
        return found == pass_.ports.end() ? nullptr : *found;
    }

    static std::string_view likeOf(const Port& port) {
        if (port.isInput()) return {};
        if (port.type.kind == PortType::Kind::image) return port.extent.like;
        return port.type.kind == PortType::Kind::buffer && port.count.kind == Count::Kind::like ? port.count.like : std::string_view();
    }

    void checkShape(const Port& port) {
        const std::string start = fmt::format("port \"{}\" ", port.name);
        const bool isHandle = port.type.kind == PortType::Kind::handle;
        if (isHandle && (port.role == Port::Role::state || port.role == Port::Role::scratch))
            add(start + "is a handle, which can't be state or scratch");
        if (port.isInput() || isHandle) return;
        if (port.count.kind == Count::Kind::reserved && port.role != Port::Role::scratch)
            add(start + "is sized as the pass runs, but what it holds is asked for from outside", "only scratch can be");
        if (port.type.kind == PortType::Kind::image && !(port.extent.scale > 0)) add(start + "has no size", "its scale must be above 0");
        if (port.type.kind == PortType::Kind::buffer && port.count.number == 0) add(start + "has no elements");
        const std::string_view like = likeOf(port);
        if (like.empty()) return;
        const Port* other = find(like);
        if (!other) {
            add(fmt::format("{}is sized like \"{}\", which is no port of the pass", start, like));
        } else if (other->type.kind == PortType::Kind::handle ||
                   (port.type.kind == PortType::Kind::image && other->type.kind != PortType::Kind::image)) {
            add(fmt::format("{}is sized like \"{}\", which has no such size", start, like));
        }
        std::size_t steps = 0;
        for (const Port* at = &port; at && !likeOf(*at).empty(); at = find(likeOf(*at))) {
            if (++steps <= pass_.ports.size()) continue;
            add(start + "is sized like itself");
            break;
        }
    }

    void checkParameter(const Parameter& p) {
        const std::string start = fmt::format("parameter \"{}\" ", p.name);
        if (p.isChoice() && std::set<std::string_view>(p.choices.begin(), p.choices.end()).size() != p.choices.size())
            add(start + "has a choice twice");
        const auto outOf = [&]<class T>(const T& initial) { return initial < std::get<T>(p.low) || initial > std::get<T>(p.high); };
        const int* whole = std::get_if<int>(&p.initial);
        const float* number = std::get_if<float>(&p.initial);
        if ((whole && outOf(*whole)) || (number && outOf(*number))) add(fmt::format("{}has a default that is not {}", start, p.typeText()));
    }

    void checkLink(const std::string& kind, const Pass::Bypass& bypass) {
        const bool known = std::ranges::count(pass_.ports, bypass.in) + std::ranges::count(pass_.ports, bypass.out) == 2;
        if (!known || !bypass.in->isInput() || bypass.out->role != Port::Role::out) {
            add("a " + kind + " must lead from an input to an output of the pass");
        } else if (!bypass.in->type.isSame(bypass.out->type)) {
            add(fmt::format("the {} from \"{}\" to \"{}\" joins {} and {}", kind, bypass.in->name, bypass.out->name, bypass.in->type.text(),
                            bypass.out->type.text()));
        }
    }

    const Pass& pass_;
    const std::string& type_;
    const Where& where_;
    Problems& problems_;
    std::set<std::string> names_;
};

}  // namespace

void checkDeclaration(const Pass& pass, const std::string& type, const Where& where, Problems& problems) {
    DeclarationCheck(pass, type, where, problems).run();
}

}  // namespace lodestir
