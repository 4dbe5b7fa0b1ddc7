// SPDX-License-Identifier: MIT
// Reads graph files: applies a variant and the command line's overrides to the JSON, then checks its form.
#include <framework/core/is_file.h>
#include <framework/graph/description.h>

#include <framework/core/file_kind.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

namespace lodestir {
namespace {

constexpr std::string_view prevMark = "@prev";

bool isName(std::string_view text) {
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    return !text.empty() && std::ranges::all_of(text, fits);
}

/// "pass.port" or "pass"; false when it is neither. The port may be a bundle's member, "paths.reservoirs".
bool readReference(std::string_view text, std::string& node, std::string& port) {
    const std::size_t dot = text.find('.');
    node = text.substr(0, dot);
    port = dot == text.npos ? std::string_view() : text.substr(dot + 1);
    const std::size_t inner = port.find('.');
    const bool isPort = isName(std::string_view(port).substr(0, inner)) && (inner == port.npos || isName(std::string_view(port).substr(inner + 1)));
    return isName(node) && (dot == text.npos || isPort);
}

/// The value as JSON where it is JSON, else as text: 2, 0.5, true, [1, 2], schedule.
Json readLooseValue(const std::string& text, const Where& where) {
    Json value;
    try {
        value = Json::parse(text, where.file);
    } catch (const Error&) {
        value = Json(text);
    }
    value.moveTo(where);
    return value;
}

/// "1280x720" -> [1280, 720]; anything else stays as it is.
Json readSizeText(Json value) {
    if (!value.isString()) return value;
    const std::string& text = value.asString();
    int width = 0, height = 0;
    const char* end = text.data() + text.size();
    const auto [cross, bad] = std::from_chars(text.data(), end, width);
    if (bad != std::errc() || cross == end || *cross != 'x') return value;
    const auto [last, alsoBad] = std::from_chars(cross + 1, end, height);
    if (alsoBad != std::errc() || last != end) return value;
    Json size = Json::array();
    size.push(width);
    size.push(height);
    size.moveTo(value.where());
    return size;
}

std::vector<std::string> keysOf(const Json* object) {
    std::vector<std::string> keys;
    if (object && object->isObject()) {
        for (const auto& [key, value] : object->members()) keys.push_back(key);
    }
    return keys;
}

void applyVariant(Json& source, const std::string& name, const Where& where) {
    const Json* variants = source.find("variants");
    const Json* patch = variants ? variants->find(name) : nullptr;
    const std::vector<std::string> known = keysOf(variants);
    if (!patch)
        throw Error(where, "no variant \"" + name + "\"", known.empty() ? "the graph has none" : didYouMean(name, known));
    if (!patch->isObject()) throw Error(patch->where(), "a variant must be an object: a merge patch of the graph");
    source.merge(Json(*patch));
}

/// What joins names of variants.
constexpr std::string_view also = " + ";

/// One after the other. "variants" itself stays what the file says until all are applied.
void applyVariants(Json& source, const std::string& names, const Where& where) {
    for (std::size_t start = 0, end = 0; end != names.npos; start = end + also.size()) {
        end = names.find(also, start);
        applyVariant(source, names.substr(start, end - start), where);
    }
}

void applySetting(Json& source, const Setting& setting) {
    const std::size_t dot = setting.name.find('.');
    const std::string node = setting.name.substr(0, dot), name = setting.name.substr(dot + 1);
    Json value = setting.value;
    value.moveTo(value.where());  // its name, too, which may stand nowhere
    if (node == "frame") {
        source["frame"][name] = std::move(value);
        return;
    }
    // The pass "scene" is there without being named; what is set on it names it. First, as it would be implied.
    const Json* passes = source.find("passes");
    if (node == "scene" && passes && passes->isObject() && !passes->find("scene")) {
        Json withScene = Json::object();
        withScene["scene"]["type"] = "scene";
        for (const auto& [other, pass] : passes->members()) withScene[other] = pass;
        source["passes"] = std::move(withScene);
        passes = source.find("passes");
    }
    if (!passes || !passes->find(node) || !passes->find(node)->isObject())
        throw Error(value.where(), "no pass \"" + node + "\"", didYouMean(node, keysOf(passes)));
    source["passes"][node]["set"][name] = std::move(value);
}

void applyOptions(Json& source, const GraphOptions& options, Problems& problems) {
    const auto place = [](Json value, const char* option) {
        value.moveTo(Where{option});
        return value;
    };
    problems.attempt([&] {
        if (!options.scene) return;
        if (options.scene->empty()) throw Error("--scene names no file");
        source["scene"] = place(std::filesystem::absolute(*options.scene).lexically_normal().string(), "--scene");
    });
    if (options.show) source["show"] = place(*options.show, "--show");
    problems.attempt([&] {
        if (options.frames) source["frame"]["count"] = place(*options.frames, "--frames");
        if (options.seed) source["frame"]["seed"] = place(std::int64_t(*options.seed), "--seed");
        if (!options.size) return;
        Json size = Json::array();
        size.push(std::int64_t(options.size->x));
        size.push(std::int64_t(options.size->y));
        source["frame"]["size"] = place(std::move(size), "--size");
    });
    for (const Setting& setting : options.set) problems.attempt([&] { applySetting(source, setting); });
}

/// Reads the members of the file one after the other; what is wrong is noted and the rest read on.
class DescriptionReader {
public:
    DescriptionReader(Description& description, Problems& problems) : d(description), problems_(problems) {}

    void read() {
        const Json& source = d.source;
        problems_.attempt([&] { source.expectOnly(keys, "the graph", problems_); });
        problems_.attempt([&] { readFormat(source); });
        if (const Json* about = source.find("about")) problems_.attempt([&] { d.about = about->asString("\"about\""); });
        if (const Json* schema = source.find("$schema")) problems_.attempt([&] { schema->asString("\"$schema\""); });
        if (const Json* scene = source.find("scene")) problems_.attempt([&] { readScene(*scene); });
        if (const Json* frame = source.find("frame")) problems_.attempt([&] { readFrame(*frame); });
        const Json* passes = source.find("passes");
        if (!passes) problems_.add(source.where(), "the graph has no \"passes\"");
        if (passes) problems_.attempt([&] { readPasses(*passes); });
        const Json* show = source.find("show");
        if (!show) problems_.add(source.where(), "the graph shows nothing", "add \"show\": \"pass.port\"");
        if (show) problems_.attempt([&] { readShow(*show); });
    }

private:
    void readFormat(const Json& source) {
        const Json* format = source.find("format");
        if (!format) throw Error(source.where(), "the graph has no \"format\"", "add \"format\": 1");
        const std::int64_t number = format->asInt("\"format\"");
        if (number != 1) throw Error(format->where(), fmt::format("format {} is not known", number), "this program reads format 1");
    }

    void readScene(const Json& scene) {
        d.sceneWhere = scene.where();
        const std::string name = scene.asString("\"scene\"");
        if (name.empty()) throw Error(scene.where(), "\"scene\" is empty", "name a scene file or leave \"scene\" out");
        d.scene = Path(name).is_absolute() ? Path(name) : namedPath(d.file.parent_path(), name).lexically_normal();
    }

    static std::int64_t readWithin(const Json& value, std::string_view what, std::int64_t low, std::int64_t high) {
        const std::int64_t number = value.asInt(what);
        if (number < low || number > high) throw Error(value.where(), fmt::format("{} must be {}..{}, not {}", what, low, high, number));
        return number;
    }

    void readFrame(const Json& frame) {
        static const std::vector<std::string> known{"size", "count", "seed"};
        frame.expectOnly(known, "\"frame\"", problems_);
        if (const Json* size = frame.find("size"))
            problems_.attempt([&] {
                const std::vector<Json>& items = size->items("\"size\"");
                if (items.size() != 2) throw Error(size->where(), "\"size\" must be [width, height], in pixels");
                problems_.attempt([&] { d.size.x = std::uint32_t(readWithin(items[0], "the frame's width", 1, maxFrameSize)); });
                problems_.attempt([&] { d.size.y = std::uint32_t(readWithin(items[1], "the frame's height", 1, maxFrameSize)); });
            });
        if (const Json* count = frame.find("count"))
            problems_.attempt([&] { d.count = int(readWithin(*count, "\"count\"", 1, std::numeric_limits<int>::max())); });
        if (const Json* seed = frame.find("seed"))
            problems_.attempt([&] { d.seed = std::uint32_t(readWithin(*seed, "\"seed\"", 0, std::numeric_limits<std::uint32_t>::max())); });
    }

    void readPasses(const Json& passes) {
        if (passes.members("\"passes\"").empty()) throw Error(passes.where(), "\"passes\" is empty");
        for (const auto& [name, value] : passes.members()) {
            if (!isName(name))
                problems_.add(value.keyWhere(), "\"" + name + "\" can't be the name of a pass", "use letters, digits, _ and -");
            if (name == "frame")
                problems_.add(value.keyWhere(), "\"frame\" can't be the name of a pass", "--set frame.seed=1 means the frame");
            d.nodes.push_back({.name = name, .where = value.keyWhere()});
            problems_.attempt([&, &node = value] { readNode(node, d.nodes.back()); });
        }
    }

    void readNode(const Json& value, NodeDescription& node) {
        static const std::vector<std::string> known{"type", "in", "set", "off", "about"};
        const std::string what = "pass \"" + node.name + "\"";
        value.expectOnly(known, what, problems_);
        const Json* type = value.find("type");
        if (!type) problems_.add(node.where, what + " has no \"type\"");
        if (type)
            problems_.attempt([&] {
                node.typeWhere = type->where();
                std::string folder, name;
                if (!readReference(type->asString("\"type\""), folder, name))
                    throw Error(type->where(), "\"" + type->asString() + "\" is no pass type", "write \"folder\" or \"folder.Struct\"");
                node.type = type->asString();
            });
        if (const Json* off = value.find("off"))
            problems_.attempt([&] {
                node.offWhere = off->where();
                node.off = off->asBool("\"off\"");
            });
        if (const Json* in = value.find("in"))
            problems_.attempt([&] {
                for (const Json::Member& input : in->members("\"in\"")) problems_.attempt([&] { node.edges.push_back(readEdge(input.first, input.second)); });
            });
        if (const Json* set = value.find("set"))
            problems_.attempt([&] {
                for (const auto& [name, setting] : set->members("\"set\"")) node.settings.push_back({name, setting});
            });
    }

    static EdgeDescription readEdge(const std::string& port, const Json& value) {
        EdgeDescription edge{.port = port, .where = value.where(), .portWhere = value.keyWhere()};
        std::string_view text = value.asString("an input");
        if (text.ends_with(prevMark)) {
            edge.prev = true;
            text.remove_suffix(prevMark.size());
        }
        if (!readReference(text, edge.fromNode, edge.fromPort)) {
            throw Error(value.where(), "\"" + value.asString() + "\" names no port", "write \"pass\", \"pass.port\" or \"pass.port@prev\"");
        }
        return edge;
    }

    void readShow(const Json& show) {
        d.showWhere = show.where();
        if (!readReference(show.asString("\"show\""), d.showNode, d.showPort))
            throw Error(show.where(), "\"" + show.asString() + "\" names no port", "write \"pass\" or \"pass.port\"");
    }

    static inline const std::vector<std::string> keys{"$schema", "format", "about", "scene", "frame", "passes", "show", "variants"};
    Description& d;
    Problems& problems_;
};

}  // namespace

Setting readSetting(const std::string& text) {
    const Where where{"--set " + text};
    const std::size_t equals = text.find('='), dot = text.find('.');
    if (equals == text.npos || dot == text.npos || dot > equals || dot == 0 || dot + 1 == equals) {
        throw Error(where, "this sets nothing", "write pass.parameter=value");
    }
    Setting setting{text.substr(0, equals), readLooseValue(text.substr(equals + 1), where)};
    if (setting.name == "frame.size") setting.value = readSizeText(std::move(setting.value));
    return setting;
}

Description readDescription(Json source, const Path& file, const GraphOptions& options) {
    Description description;
    Problems problems;
    description.file = file;
    description.source = std::move(source);
    if (!description.source.isObject())
        throw Error(description.source.where(), "a graph must be an object, not " + std::string(description.source.kindName()));
    if (const Json* variants = description.source.find("variants")) {
        if (!variants->isObject()) throw Error(variants->where(), "\"variants\" must be an object of merge patches");
        description.variants = keysOf(variants);
        for (const auto& [name, patch] : variants->members())
            if (name.find(also) != name.npos)
                throw Error(patch.keyWhere(), "the name of a variant can't hold \" + \"", "it joins names: \"a + b\" is a and then b");
    }
    if (options.variant) applyVariants(description.source, *options.variant, options.variantWhere.file.empty() ? Where{file.string()} : options.variantWhere);
    description.source.remove("variants");
    for (const Json& patch : options.patches) description.source.merge(patch);
    applyOptions(description.source, options, problems);
    DescriptionReader(description, problems).read();
    problems.raise();
    return description;
}

Description loadDescription(const Path& file, const GraphOptions& options) {
    expectNoModel(file, FileKind::graph);
    Json source = Json::load(file);
    expectKind(source, FileKind::graph);
    return readDescription(std::move(source), file, options);
}

}  // namespace lodestir
