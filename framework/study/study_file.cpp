// SPDX-License-Identifier: MIT
#include <framework/core/file_kind.h>
#include <framework/core/is_file.h>
#include <framework/image/temporal.h>
#include <framework/scene/fields.h>
#include <framework/study/named.h>
#include <framework/study/report/report.h>
#include <framework/study/study_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <set>

namespace lodestir {
namespace {

/// Seeds above are kept for references, so that none is ever compared with itself.
constexpr int maxSeed = std::numeric_limits<int>::max();
constexpr int leastRuns = 16;  // an ensemble's: fewer tell nothing of their own skewness
constexpr int maxFrame = 1'000'000'000, maxSeedCount = 100'000, maxReferenceSamples = 1 << 24;

class StudyReader {
public:
    explicit StudyReader(const Path& file) : json_(load(file)) { study_.file = file; }

    Study read() {
        Fields fields(json_, "the study", problems_);
        fields.allow({"$schema"});
        int format = 1;
        if (fields.require("format")) fields.integer("format", format, 1, 1);
        fields.text("about", study_.about);
        std::size_t kind = 0;
        fields.choice("kind", kind, {"error", "ensemble"});
        study_.kind = StudyKind(kind);
        readScenes(fields.require("scenes"));
        study_.sizes = {StudyScene().size};
        problems_.attempt([&] { readSizes(fields.find("size")); });
        takeSizes();
        study_.measure = {0};
        if (const Json* frames = fields.find("frames")) readFrames(*frames);
        if (const Json* reference = fields.require("reference")) readReference(*reference);
        if (study_.kind == StudyKind::error) readBudget(fields.find("equal"));
        readTechniques(fields.require("techniques"));
        problems_.attempt([&] { study_.paired = readFlag(fields.find("paired"), "\"paired\""); });
        if (study_.kind == StudyKind::ensemble) {
            readRuns(fields);
        } else {
            problems_.attempt([&] { readSeeds(fields.require("seeds")); });
            std::vector<std::string> metrics = metricNames();
            std::ranges::copy(temporalMetricNames(), std::back_inserter(metrics));
            study_.metrics = readNames(fields.find("metrics"), "metric", metrics, {"relmse", "mse"});
            checkSteps(fields.find("metrics"));
            study_.charts = readNames(fields.find("charts"), "chart", chartNames(), chartNames());
            readMasks(fields);
            readCounters(fields);
            readBaseline(fields);
            problems_.attempt([&] { study_.decompose = readFlag(fields.find("decompose"), "\"decompose\""); });
            if (const Json* outcomes = fields.find("outcomes")) study_.outcomes = readOutcomes(*outcomes, study_, problems_);
        }
        fields.finish();
        problems_.raise();
        checkBudget();
        checkRuns();
        return std::move(study_);
    }

private:
    static Json load(const Path& file) {
        expectNoModel(file, FileKind::study);
        Json json = Json::load(file);
        expectKind(json, FileKind::study);
        return json;
    }
    /// Lists of values multiply: four of a hundred values each are a hundred million runs.
    void checkRuns() const {
        constexpr double most = 1e6;
        double runs = 0;
        for (const Technique& technique : study_.techniques) {
            double combinations = double(study_.scenes.size()) * double(study_.seeds.size());
            for (const Knob& knob : technique.vary) combinations *= double(knob.values.size());
            runs += combinations;
        }
        if (runs > most)
            throw Error(json_.where(), fmt::format("the study asks for {:.3g} runs, more than {:.0f}", runs, most),
                        "scenes, seeds and the values in \"vary\" multiply");
    }
    static bool readFlag(const Json* value, const char* what) { return value && value->asBool(what); }
    static std::int64_t within(const Json& value, const std::string& what, std::int64_t low, std::int64_t high) {
        const std::int64_t number = value.asInt(what);
        if (number < low || number > high) throw Error(value.where(), fmt::format("{} must be {}..{}, not {}", what, low, high, number));
        return number;
    }
    Path resolve(const Json& value, const std::string& what) const {
        const std::string name = value.asString(what);
        const Path whole = Path(name).is_absolute() ? Path(name) : namedPath(study_.file.parent_path(), name).lexically_normal();
        if (!isFile(whole)) throw Error(value.where(), fmt::format("there is no file {}", whole.string()));
        return whole;
    }

    void readScenes(const Json* scenes) {
        problems_.attempt([&] {
            if (!scenes) return;
            if (scenes->items("\"scenes\"").empty()) throw Error(scenes->where(), "the study has no scenes");
            for (const Json& item : scenes->items())
                problems_.attempt([&] {
                    const Path file = resolve(item, "a scene");
                    const std::string name = file.stem().string();
                    if (std::ranges::find(study_.scenes, name, &StudyScene::name) != study_.scenes.end())
                        throw Error(item.where(), fmt::format("two scenes are named \"{}\"", name));
                    study_.scenes.push_back({name, file, item.where()});
                });
        });
    }

    static glm::uvec2 sizeOf(const Json& json) {
        if (json.items("a size").size() != 2) throw Error(json.where(), "a size must be [width, height], in pixels");
        glm::uvec2 size;
        for (int i = 0; i < 2; ++i) size[i] = std::uint32_t(within(json.items()[std::size_t(i)], i == 0 ? "the width" : "the height", 1, 16384));
        return size;
    }
    /// One, or a list of them.
    void readSizes(const Json* sizes) {
        if (!sizes) return;
        const auto& items = sizes->items("\"size\"");
        if (items.empty() || !items.front().isArray()) {
            study_.sizes = {sizeOf(*sizes)};
            return;
        }
        if (study_.kind == StudyKind::ensemble) throw Error(sizes->where(), "an ensemble has one size");
        study_.sizes.clear();
        for (const Json& item : items) {
            const glm::uvec2 size = sizeOf(item);
            if (std::ranges::find(study_.sizes, size) != study_.sizes.end())
                throw Error(item.where(), fmt::format("the size {}x{} is given twice", size.x, size.y));
            study_.sizes.push_back(size);
        }
    }
    void takeSizes() {
        std::vector<StudyScene> scenes;
        for (const StudyScene& scene : study_.scenes)
            for (const glm::uvec2 size : study_.sizes) {
                scenes.push_back(scene);
                scenes.back().size = size;
                if (study_.sizes.size() > 1) scenes.back().name += fmt::format(", {}x{}", size.x, size.y);
            }
        study_.scenes = std::move(scenes);
    }

    void readSeeds(const Json* seeds) {
        if (!seeds) return;
        if (seeds->isArray()) {
            for (const Json& item : seeds->items()) {
                const auto seed = std::uint32_t(within(item, "a seed", 0, maxSeed));
                if (std::ranges::find(study_.seeds, seed) != study_.seeds.end())
                    throw Error(item.where(), fmt::format("the seed {} is given twice", seed));
                study_.seeds.push_back(seed);
            }
            if (study_.seeds.empty()) throw Error(seeds->where(), "there are no seeds");
            return;
        }
        const std::int64_t count = within(*seeds, "the number of seeds", 1, maxSeedCount);
        for (std::uint32_t seed = 1; seed <= count; ++seed) study_.seeds.push_back(seed);
    }

    /// Of an ensemble: how many runs, from which seed on, and how sure it has to be.
    void readRuns(Fields& fields) {
        problems_.attempt([&] {
            const Json* runs = fields.require("runs");
            int seed = 1;
            fields.integer("seed", seed, 0, maxSeed - maxSeedCount);
            const std::int64_t count = runs ? within(*runs, "the number of runs", leastRuns, maxSeedCount) : 0;
            for (std::int64_t i = 0; i < count; ++i) study_.seeds.push_back(std::uint32_t(seed + i));
        });
        problems_.attempt([&] {
            const Json* width = fields.find("halfWidth");
            if (!width) return;
            study_.halfWidth = width->asNumber("\"halfWidth\"");
            if (!(study_.halfWidth > 0 && study_.halfWidth <= 0.1))
                throw Error(width->where(), fmt::format("\"halfWidth\" must be above 0 and at most 0.1, not {:g}", study_.halfWidth),
                            "it is a share of the energy: 0.003 is 0.3 %");
        });
    }

    /// Frames counted from the event, rising.
    std::vector<int> readOffsets(const Json& list, const char* key, const char* what) const {
        std::vector<int> offsets;
        for (const Json& item : list.items(key)) {
            const int offset = int(within(item, what, -study_.warmup, maxFrame));
            if (std::ranges::find(offsets, offset) != offsets.end())
                throw Error(item.where(), fmt::format("frame {} stands in {} twice", offset, key));
            offsets.push_back(offset);
        }
        if (offsets.empty()) throw Error(list.where(), fmt::format("{} holds no frame", key));
        std::ranges::sort(offsets);
        return offsets;
    }

    void readFrames(const Json& value) {
        Fields frames(value, "\"frames\"", problems_);
        frames.integer("warmup", study_.warmup, 0, maxFrame);
        study_.event = study_.warmup;
        frames.integer("event", study_.event, 0, maxFrame);
        if (study_.event < study_.warmup)
            problems_.add(value.where(), fmt::format("{} frames of warm-up don't fit before frame {}", study_.warmup, study_.event));
        problems_.attempt([&] {
            if (const Json* measure = frames.find("measure")) study_.measure = readOffsets(*measure, "\"measure\"", "a measured frame");
        });
        frames.finish();
    }

    void readGraph(Fields& fields, StudyGraph& graph) {
        const Json* file = fields.require("graph");
        if (file) graph.where = file->where();
        if (file) problems_.attempt([&] { graph.graph = resolve(*file, "\"graph\""); });
        if (const Json* variant = fields.find("variant")) problems_.attempt([&] {
            graph.variant = variant->asString("\"variant\"");
            graph.variantWhere = variant->where();
        });
        if (const Json* port = fields.find("port")) graph.portWhere = port->where();
        fields.text("port", graph.port);
        if (const Json* set = fields.find("set"))
            problems_.attempt([&] {
                for (const auto& [name, setting] : set->members("\"set\"")) graph.set.push_back({checkedName(name, setting, setting.keyWhere()), setting});
            });
    }
    static std::string checkedName(const std::string& name, const Json& value, const Where& nameWhere) {
        const std::size_t dot = name.find('.');
        if (dot == 0 || dot == name.npos || dot + 1 == name.size() || name.find('=') != name.npos)
            throw Error(nameWhere, fmt::format("\"{}\" names no parameter", name), "write \"pass.parameter\"");
        if (name.starts_with("frame."))
            throw Error(nameWhere, fmt::format("\"{}\" belongs to the whole study", name),
                        "size, seeds and frames stand beside \"techniques\"");
        if (value.isArray() || value.isObject() || value.isNull())
            throw Error(value.where(), fmt::format("a parameter's value can't be {}", value.kindName()),
                        "lists of values stand in \"vary\"");
        return name;
    }

    /// Metrics of sequences need two measured frames in a row.
    void checkSteps(const Json* metrics) {
        const auto follows = [](int before, int frame) { return before + 1 == frame; };
        if (!metrics || !metrics->isArray() || std::ranges::adjacent_find(study_.measure, follows) != study_.measure.end()) return;
        for (const Json& item : metrics->items())
            if (item.isString() && isTemporal(item.asString()))
                problems_.add(item.where(), fmt::format("\"{}\" needs two measured frames in a row", item.asString()),
                              "add the frame before to \"measure\"");
    }

    /// "switched", and those that ports of graphs say.
    void readMasks(Fields& fields) {
        std::size_t mask = 0;
        fields.choice("mask", mask, {"none", "switched", "switched_if_any"});
        if (mask >= 1) study_.masks.push_back({.name = "switched", .graph = {}, .optional = mask == 2});
        problems_.attempt([&] {
            const Json* masks = fields.find("masks");
            if (!masks) return;
            for (const auto& [name, value] : masks->members("\"masks\"")) {
                if (name.empty() || name.find('.') != name.npos || name == "finest" || name == "switched")
                    throw Error(value.keyWhere(), fmt::format("a mask can't be named \"{}\"", name),
                                "its name stands behind that of a metric, as in relmse.name");
                StudyGraph graph;
                if (value.isString()) {
                    graph = {.graph = graphFolder() / "framework/seen.json", .port = value.asString(), .where = value.where(), .portWhere = value.where()};
                } else {
                    Fields members(value, fmt::format("mask \"{}\"", name), problems_);
                    readGraph(members, graph);
                    members.finish();
                }
                study_.masks.push_back({name, std::move(graph)});
            }
        });
    }

    void readCounters(Fields& fields) {
        problems_.attempt([&] { study_.countSteps = readFlag(fields.find("countSteps"), "\"countSteps\""); });
        problems_.attempt([&] {
            const Json* counts = fields.find("counts");
            if (!counts) return;
            for (const auto& [name, port] : counts->members("\"counts\"")) {
                if (name.empty() || name == stepsName) throw Error(port.keyWhere(), fmt::format("a count can't be named \"{}\"", name));
                study_.counters.push_back({name, port.asString("a port"), port.where()});
            }
        });
    }

    std::size_t techniqueNamed(const std::string& name, const Where& where) const {
        return indexNamed<&Technique::name>(study_.techniques, name, "technique", where);
    }
    void readBaseline(Fields& fields) {
        problems_.attempt([&] {
            if (const Json* baseline = fields.find("baseline")) study_.baseline = techniqueNamed(baseline->asString("\"baseline\""), baseline->where());
        });
    }

    /// One cost that all are given: a number, or the name of a technique that takes it.
    void readBudget(const Json* equal) {
        problems_.attempt([&] {
            if (!equal) return;
            const auto& members = equal->members("\"equal\"");
            constexpr std::array<std::string_view, 3> kinds{"time", "rays", stepsName};  // as Budget::Kind
            const auto kind = members.size() == 1 ? std::ranges::find(kinds, members[0].first) : kinds.end();
            if (kind == kinds.end())
                throw Error(equal->where(), "\"equal\" needs a \"time\", \"rays\" or \"steps\"",
                            "write { \"time\": milliseconds }, { \"rays\": rays a pixel } or { \"steps\": steps a pixel }");
            const Json& value = members[0].second;
            Budget budget{.kind = Budget::Kind(kind - kinds.begin()), .where = value.where()};
            if (value.isString()) {
                budget.technique = value.asString();
            } else {
                budget.value = value.asNumber("the budget");
                if (!(budget.value > 0)) throw Error(value.where(), fmt::format("the budget must be above 0, not {:g}", budget.value));
            }
            study_.equal = budget;
        });
    }
    /// Its technique is there and has a cost of its own, and some technique is given the budget.
    void checkBudget() const {
        if (!study_.equal) return;
        if (study_.equal->kind == Budget::Kind::steps && !study_.countSteps)
            throw Error(study_.equal->where, "steps are a budget, and aren't counted", "add \"countSteps\": true to the study");
        if (std::ranges::none_of(study_.techniques, [](const Technique& t) { return t.solve.has_value(); }))
            throw Error(study_.equal->where, "no technique has a knob for the budget", "add \"solve\": { \"pass.parameter\": [least, most] } to one");
        if (study_.equal->technique.empty()) return;
        const Technique& named = study_.techniques[techniqueNamed(study_.equal->technique, study_.equal->where)];
        if (named.solve || !named.vary.empty())
            throw Error(study_.equal->where, fmt::format("\"{}\" has no cost of its own to give others", named.name),
                        "name a technique without \"vary\" and \"solve\"");
    }

    void readSolve(const Json& solve, Technique& technique) {
        const auto& members = solve.members("\"solve\"");
        if (!study_.equal) throw Error(solve.keyWhere(), "there is no budget to solve for", "add \"equal\" to the study");
        if (members.size() != 1) throw Error(solve.where(), "one knob is solved for", "write { \"pass.parameter\": [least, most] }");
        const auto& [name, range] = members[0];
        checkedName(name, Json(1), range.keyWhere());
        const auto isSame = [&, &knob = name](const auto& other) { return other.name == knob; };
        if (std::ranges::any_of(technique.graph.set, isSame) || std::ranges::any_of(technique.vary, isSame))
            throw Error(range.keyWhere(), fmt::format("\"{}\" is set or varied, and solved for", name), "remove one of them");
        if (range.items("a range").size() != 2) throw Error(range.where(), "a range must be [least, most]");
        const int low = int(within(range.items()[0], "the least value", 0, maxFrame));
        technique.solve = {name, low, int(within(range.items()[1], "the most", low, maxFrame)), range.keyWhere()};
    }

    void readReference(const Json& value) {
        Fields fields(value, "the reference", problems_);
        readGraph(fields, study_.reference);
        if (study_.kind == StudyKind::error) problems_.attempt([&] { study_.referenceFinest = readFlag(fields.find("finest"), "\"finest\""); });
        if (study_.kind == StudyKind::error) problems_.attempt([&] { study_.referenceExact = readFlag(fields.find("exact"), "\"exact\""); });
        const Json* samples = study_.referenceExact ? fields.find("spp") : fields.require("spp");
        if (samples)
            problems_.attempt([&] {
                if (study_.referenceExact) throw Error(samples->keyWhere(), "an exact reference takes no samples", "remove \"spp\" or \"exact\"");
                study_.referenceSamples = int(within(*samples, "the reference's \"spp\"", 2, maxReferenceSamples));
                if (study_.kind == StudyKind::ensemble && study_.referenceSamples % referenceBatches != 0)
                    throw Error(samples->where(), fmt::format("the reference's \"spp\" must be a multiple of {}", referenceBatches),
                                "an ensemble's is rendered in as many batches, which tell its noise");
                if (study_.referenceSamples % 2 != 0)
                    throw Error(samples->where(), "the reference's \"spp\" must be even", "it is rendered in two halves");
            });
        fields.finish();
    }

    void readTechniques(const Json* techniques) {
        problems_.attempt([&] {
            if (!techniques) return;
            if (techniques->members("\"techniques\"").empty()) throw Error(techniques->where(), "the study has no techniques");
            for (const auto& [name, value] : techniques->members()) {
                Fields fields(value, fmt::format("technique \"{}\"", name), problems_);
                Technique technique{.name = name};
                readGraph(fields, technique.graph);
                if (const Json* vary = fields.find("vary")) problems_.attempt([&] { readVary(*vary, technique); });
                problems_.attempt([&] { technique.otherFilter = readFlag(fields.find("otherFilter"), "\"otherFilter\""); });
                if (study_.kind == StudyKind::error) {
                    if (const Json* solve = fields.find("solve")) problems_.attempt([&] { readSolve(*solve, technique); });
                    std::size_t ablate = 0;
                    fields.choice("ablate", ablate, {"none", "auto", "pairs"});
                    technique.ablate = Ablate(ablate);
                    if (const Json* clear = fields.find("clear"))
                        problems_.attempt([&] { technique.clear = readOffsets(*clear, "\"clear\"", "a frame before which history is cleared"); });
                } else {
                    problems_.attempt([&] { technique.control = readFlag(fields.find("control"), "\"control\""); });
                    problems_.attempt([&] { technique.planted = readFlag(fields.find("planted"), "\"planted\""); });
                    if (technique.control && technique.planted)
                        problems_.add(value.where(), fmt::format("technique \"{}\" can't be both right and wrong", name),
                                      "\"control\" is known to be unbiased, \"planted\" to be biased");
                }
                if (const Json* alike = fields.find("alike")) problems_.attempt([&] { readAlike(*alike, technique); });
                fields.finish();
                study_.techniques.push_back(std::move(technique));
            }
        });
    }

    /// Behind all that gives parameters values, because each of these takes one of those.
    void readAlike(const Json& alike, Technique& technique) {
        std::vector<std::string> given;
        for (const Setting& setting : technique.graph.set) given.push_back(setting.name);
        for (const Knob& knob : technique.vary) given.push_back(knob.name);
        if (technique.solve) given.push_back(technique.solve->name);
        for (const Json::Member& member : alike.members("\"alike\""))
            problems_.attempt([&] {
                const auto& [name, value] = member;
                const std::string& from = value.asString("a parameter");
                checkedName(name, value, value.keyWhere());
                if (std::ranges::find(given, name) != given.end())
                    throw Error(value.keyWhere(), fmt::format("\"{}\" is given a value, and takes that of \"{}\"", name, from), "remove one of them");
                if (std::ranges::find(given, from) == given.end()) {
                    const std::string meant = didYouMean(from, given);
                    throw Error(value.where(), fmt::format("\"{}\" is given no value that \"{}\" could take", from, name),
                                meant.empty() ? "give it one with \"set\", \"vary\" or \"solve\"" : meant);
                }
                technique.graph.alike.push_back({name, from, value.keyWhere()});
            });
    }

    void readVary(const Json& vary, Technique& technique) {
        for (const Json::Member& member : vary.members("\"vary\""))
            problems_.attempt([&] {
                const auto& [name, values] = member;
                if (values.items(fmt::format("\"{}\"", name)).empty())
                    throw Error(values.where(), fmt::format("\"{}\" has no values to take", name));
                if (std::ranges::find(technique.graph.set, name, &Setting::name) != technique.graph.set.end())
                    throw Error(values.keyWhere(), fmt::format("\"{}\" is set and varied", name), "remove one of them");
                Knob knob{.name = name};
                for (const Json& item : values.items()) {
                    checkedName(name, item, values.keyWhere());
                    if (std::ranges::any_of(knob.values, [&](const Json& v) { return v.dump(-1) == item.dump(-1); }))
                        throw Error(item.where(), fmt::format("\"{}\" takes {} twice", name, item.dump(-1)));
                    knob.values.push_back(item);
                }
                technique.vary.push_back(std::move(knob));
            });
    }

    std::vector<std::string> readNames(const Json* value, const std::string& what, const std::vector<std::string>& known,
                                       std::vector<std::string> names) {
        if (!value) return names;
        names.clear();
        problems_.attempt([&] {
            for (const Json& item : value->items(fmt::format("\"{}s\"", what)))
                problems_.attempt([&] {
                    const std::string& name = item.asString("a " + what);
                    if (std::ranges::find(known, name) == known.end())
                        throw Error(item.where(), fmt::format("unknown {} \"{}\"", what, name), didYouMean(name, known));
                    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
                });
            if (what == "metric" && value->items().empty()) throw Error(value->where(), "no metric is measured");
        });
        return names;
    }

    Json json_;
    Study study_;
    Problems problems_;
};

}  // namespace

std::vector<Measure> measuresOf(const Study& study) {
    std::vector<Measure> measures;
    const auto add = [&](const std::string& mask, bool finest) {
        for (const std::string& metric : study.metrics) measures.push_back({metric, mask, finest});
    };
    for (const bool finest : {false, true}) {
        if (finest && !study.referenceFinest) continue;
        for (const Mask& mask : study.masks) add(mask.name, finest);
        add({}, finest);
    }
    return measures;
}

bool Study::judgesTime() const {
    if (kind != StudyKind::error) return false;
    std::set<std::string> timed{"error_vs_time", "frontier", "time_by_pass"};
    if (!countSteps) timed.insert({"advantage", "cost_vs_model"});  // steps are what things cost, where they are counted
    return (equal && equal->kind == Budget::Kind::time) || std::ranges::any_of(charts, [&](const std::string& chart) { return timed.contains(chart); });
}

std::vector<std::string> Study::countNames() const {
    std::vector<std::string> names;
    for (const Counter& counter : counters) names.push_back(counter.name);
    if (countSteps) names.emplace_back(stepsName);
    return names;
}

Study loadStudy(const Path& file) { return StudyReader(file).read(); }

}  // namespace lodestir
