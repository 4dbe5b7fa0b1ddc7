// SPDX-License-Identifier: MIT
// A pass's declaration as JSON facts, and as the schema of graph files.
#include <framework/graph/graph.h>
#include <framework/graph/schema.h>
#include <framework/graph/wire.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lodestir {
namespace {

const char* roleName(Port::Role role) {
    static constexpr std::array names{"in", "out", "state", "scratch"};
    return names[static_cast<std::size_t>(role)];
}

/// What is said of a port; of a bundle also what it is made of.
Json portFacts(const Wire& wire) {
    const Port& port = wire.port();
    Json fact = Json::object();
    fact["name"] = std::string(wire.name());
    fact["role"] = roleName(port.role);
    fact["type"] = wire.typeText();
    for (const Wire& member : membersOf(wire)) fact["members"].push(portFacts(member));
    if (!wire.bundle && port.type.kind != PortType::Kind::image) fact["bytes"] = std::int64_t(port.type.size);
    if (!port.isInput() && port.type.kind == PortType::Kind::image) fact["format"] = std::string(factsOf(port.format).name);
    if (const std::string size = sizeText(port); !size.empty()) fact["size"] = size;
    if (port.isInput() || port.optional) fact["optional"] = port.optional;
    fact["doc"] = std::string(wire.doc());
    return fact;
}

const char* kindName(const Parameter& p) {
    if (p.isChoice()) return "choice";
    if (p.isFile) return "file";
    static constexpr std::array names{"bool", "int", "float", "text"};
    return names[p.initial.index()];
}

bool isNumber(const Parameter& p) {
    return !p.isChoice() && (std::holds_alternative<int>(p.initial) || std::holds_alternative<float>(p.initial));
}

Json choicesOf(const Parameter& p) {
    Json choices = Json::array();
    for (const std::string_view choice : p.choices) choices.push(std::string(choice));
    return choices;
}

Json parameterFacts(const Parameter& p) {
    Json fact = Json::object();
    fact["name"] = std::string(p.name);
    fact["kind"] = kindName(p);
    if (p.isChoice()) fact["choices"] = choicesOf(p);
    if (isNumber(p)) {
        fact["low"] = writeValue(p, p.low);
        fact["high"] = writeValue(p, p.high);
    }
    fact["default"] = writeValue(p, p.initial);
    fact["constant"] = p.constant;
    fact["doc"] = std::string(p.doc);
    return fact;
}

Json described(const char* type, std::string_view description) {
    Json schema = Json::object();
    schema["type"] = type;
    if (!description.empty()) schema["description"] = std::string(description);
    return schema;
}

Json parameterSchema(const Parameter& p) {
    Json schema = Json::object();
    if (p.isChoice()) {
        schema["enum"] = choicesOf(p);
    } else {
        static constexpr std::array names{"boolean", "integer", "number", "string"};
        schema["type"] = names[p.initial.index()];
    }
    if (isNumber(p)) {
        schema["minimum"] = writeValue(p, p.low);
        schema["maximum"] = writeValue(p, p.high);
    }
    schema["default"] = writeValue(p, p.initial);
    schema["description"] = fmt::format("{} ({})", p.doc, p.typeText());
    return schema;
}

Json closedObject() {
    Json schema = described("object", "");
    schema["additionalProperties"] = false;
    schema["properties"] = Json::object();
    return schema;
}

/// What "in", "set" and "off" may be when "type" is this pass.
Json passRule(const PassType& type) {
    Json in = closedObject(), set = closedObject(), required = Json::array();
    for (const Wire& wire : wiresOf(*type.pass, [](const Port& port) { return port.isInput(); })) {
        const bool optional = wire.port().optional, bindsItself = wire.port().type.kind == PortType::Kind::handle;
        Json& edge = in["properties"][wire.name()];
        edge["$ref"] = "#/$defs/source";
        edge["description"] = fmt::format("{}: {}{}", wire.typeText(), wire.doc(), optional ? " (optional)" : "");
        if (!optional && !bindsItself) required.push(std::string(wire.name()));
    }
    const bool needsInputs = !required.items().empty();
    if (needsInputs) in["required"] = std::move(required);
    for (const Parameter* parameter : type.pass->parameters) set["properties"][parameter->name] = parameterSchema(*parameter);
    Json rule = Json::object();
    rule["if"]["properties"]["type"]["const"] = type.type;
    Json& then = rule["then"];
    then["properties"]["in"] = std::move(in);
    then["properties"]["set"] = std::move(set);
    if (type.pass->bypasses.empty()) then["properties"]["off"]["const"] = false;
    if (needsInputs) then["required"].push("in");
    return rule;
}

Json passSchema(std::span<const PassType> types) {
    Json pass = closedObject();
    pass["required"].push("type");
    Json& names = pass["properties"]["type"]["anyOf"];
    names = Json::array();
    pass["allOf"] = Json::array();
    for (const PassType& type : types) {
        Json name = Json::object();
        name["const"] = type.type;
        name["description"] = type.doc;
        names.push(std::move(name));
        pass["allOf"].push(passRule(type));
    }
    if (types.empty()) pass["properties"]["type"] = described("string", "");
    pass["properties"]["about"] = described("string", "a comment");
    pass["properties"]["in"] = described("object", "where each input comes from");
    pass["properties"]["set"] = described("object", "parameters that differ from their defaults");
    pass["properties"]["off"] = described("boolean", "hand the inputs through instead of running");
    return pass;
}

Json frameSchema() {
    Json frame = closedObject();
    Json& size = frame["properties"]["size"];
    size = described("array", "width and height, pixels");
    size["items"] = described("integer", "");
    size["items"]["minimum"] = 1;
    size["items"]["maximum"] = maxFrameSize;
    size["minItems"] = 2;  // each by itself: adding a member moves the others
    size["maxItems"] = 2;
    frame["properties"]["count"] = described("integer", "frames to render");
    frame["properties"]["count"]["minimum"] = 1;
    frame["properties"]["seed"] = described("integer", "of all random numbers");
    frame["properties"]["seed"]["minimum"] = 0;
    frame["properties"]["seed"]["maximum"] = std::int64_t(0xffffffff);
    return frame;
}

}  // namespace

PassType makePassType(const std::string& type, const Plugin& plugin) {
    PassType made{type, plugin.doc, std::unique_ptr<Pass>(plugin.create())};
    made.pass->shader = plugin.shader;
    return made;
}

std::string sizeText(const Port& port) {
    if (port.isInput() || port.type.kind == PortType::Kind::handle) return {};
    if (port.type.kind == PortType::Kind::image) {
        const std::string base = port.extent.like.empty() ? "frame" : "like " + std::string(port.extent.like);
        if (port.extent.scale == 1) return base;
        return port.extent.like.empty() ? fmt::format("{} of the frame", port.extent.scale)
                                        : fmt::format("{} of {}", port.extent.scale, port.extent.like);
    }
    switch (port.count.kind) {
    case Count::Kind::perPixel: return fmt::format("{} per pixel", port.count.number);
    case Count::Kind::fixed: return fmt::format("{} elements", port.count.number);
    case Count::Kind::reserved: return "as the pass needs";
    case Count::Kind::like: break;
    }
    return "like " + std::string(port.count.like);
}

Json facts(const PassType& type) {
    Json out = Json::object();
    out["type"] = type.type;
    out["doc"] = type.doc;
    out["shader"] = std::string(type.pass->shader);
    out["cadence"] = type.pass->cadence == Cadence::onChange ? "onChange" : "everyFrame";
    out["canBeOff"] = !type.pass->bypasses.empty();
    out["ports"] = Json::array();
    for (const Wire& wire : wiresOf(*type.pass)) out["ports"].push(portFacts(wire));
    out["parameters"] = Json::array();
    for (const Parameter* parameter : type.pass->parameters) out["parameters"].push(parameterFacts(*parameter));
    return out;
}

Json graphSchema(std::span<const PassType> types) {
    Json schema = Json::object();
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = "Lodestir graph";
    schema["type"] = "object";
    for (const char* key : {"format", "passes", "show"}) schema["required"].push(key);
    schema["additionalProperties"] = false;
    Json& properties = schema["properties"];
    properties["$schema"] = described("string", "");
    properties["format"]["const"] = 1;
    properties["about"] = described("string", "one sentence on what the graph is for");
    properties["scene"] = described("string", "scene file or glTF model, relative to this file");
    properties["frame"] = frameSchema();
    properties["passes"] = described("object", "the passes by name; their order here breaks ties");
    properties["passes"]["minProperties"] = 1;
    properties["passes"]["propertyNames"]["pattern"] = "^[A-Za-z0-9_-]+$";
    properties["passes"]["additionalProperties"]["$ref"] = "#/$defs/pass";
    properties["show"] = described("string", "the port that is shown: pass.port, pass.bundle.member, or pass where it has one output");
    properties["variants"] = described("object", "merge patches of this graph by name");
    properties["variants"]["additionalProperties"] = described("object", "");
    schema["$defs"]["pass"] = passSchema(types);
    Json& source = schema["$defs"]["source"];
    source = described("string", "pass.port, or pass where one of its outputs has the type; @prev: last frame's value");
    source["pattern"] = "^[A-Za-z0-9_-]+(\\.[A-Za-z0-9_-]+){0,2}(@prev)?$";
    return schema;
}

}  // namespace lodestir
