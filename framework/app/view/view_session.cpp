// SPDX-License-Identifier: MIT
#include <framework/app/view/view_session.h>

#include <framework/app/dump.h>
#include <framework/app/run_report.h>
#include <framework/app/view/graph_text.h>
#include <framework/app/view/port_info.h>
#include <framework/app/view/smooth.h>
#include <framework/core/log.h>
#include <framework/gpu/include_closure.h>
#include <framework/graph/kernel_source.h>
#include <framework/image/exr.h>
#include <framework/image/png.h>
#include <framework/image/preview.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace lodestir {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

constexpr std::size_t framesRemembered = 240;

bool sameView(const CameraKey& a, const CameraKey& b) {
    return a.position == b.position && a.target == b.target && a.up == b.up && a.fovy == b.fovy && a.height == b.height &&
           a.aperture == b.aperture && a.focus == b.focus;
}

}  // namespace

ViewSession::ViewSession(SessionOptions options, ComparedFirst first, std::shared_ptr<const gpu::Device> device, Publish publish)
    : options_(std::move(options)), first_(std::move(first)), device_(std::move(device)), publish_(std::move(publish)), captures_(device_) {}

void ViewSession::tell() {
    status_.undo = history_.undoable();
    status_.redo = history_.redoable();
    status_.a = sides_.a();
    status_.compared = sides_.numbers();
    if (!lost_.empty()) status_.refused = "A";
    for (std::string& problem : lost_) status_.problems.push_back(std::move(problem));
    lost_.clear();
    publish_(status_);
}

/// Runs something that may find the user's files wrong; what it finds is shown, and nothing else happens.
bool ViewSession::attempt(const std::function<void()>& work) {
    std::vector<std::string> problems;
    try {
        work();
    } catch (const Error& error) {
        for (const Problem& problem : error.problems()) {
            problems.push_back(problem.text());
            log::warn("{}", problem.text());
        }
    }
    status_.problems = std::move(problems);
    status_.refused.clear();
    return status_.problems.empty();
}

/// What was set by hand goes over what the file says, unless the file says something new about it.
void ViewSession::adjust(Graph& graph) {
    std::map<std::string, Value> given;
    for (const GraphNode& node : graph.nodes)
        for (Parameter* parameter : node.pass->parameters) {
            const std::string name = node.name + "." + std::string(parameter->name);
            given[name] = parameter->value;
            const auto set = set_.find(name);
            if (set == set_.end()) continue;
            const auto before = given_.find(name);
            const bool edited = before != given_.end() && before->second != parameter->value;
            if (edited || set->second.index() != parameter->value.index()) set_.erase(set);
            else parameter->value = set->second;
        }
    given_ = std::move(given);
}

/// Tells how far the shaders of a session are.
std::function<void(std::size_t, std::size_t)> ViewSession::compiling() {
    return [this](std::size_t done, std::size_t all) {
        status_.busy = fmt::format("compiling shader {} of {}", std::min(done + 1, all), all);
        tell();
    };
}

bool ViewSession::build() {
    status_.busy = "building";
    tell();
    const auto given = given_, set = set_;
    const std::string shown = shown_;
    const bool built = attempt([&] {
        try {
            SessionParts parts{.device = device_,
                               .scene = session_ && !rereadScene_ ? session_->sharedScene() : nullptr,
                               .adjust = [this](Graph& graph) { adjust(graph); },
                               .slice = slice,
                               .keepAll = true};
            parts.compiled = compiling();
            SessionOptions options = options_;
            if (!shown_.empty()) options.dumps.push_back(shown_);
            std::unique_ptr<Session> next;
            try {
                next = std::make_unique<Session>(options, parts);
            } catch (const Error&) {
                if (shown_.empty()) throw;
                shown_.clear();  // a graph without the port that was looked at: shows its own
                next = std::make_unique<Session>(options_, parts);
            }
            if (scenePath_ && next->sharedScene() != session_->sharedScene()) {
                if (next->scene().file == session_->scene().file) scenePath_ = std::exchange(next->sharedScene()->camera, session_->scene().camera);
                else scenePath_.reset();
            }
            status_.busy = "building";
            if (session_) next->runner().setFrame(session_->runner().nextFrame());
            const auto start = Clock::now();
            const FrameReport report = next->runner().run();
            asking_.reset();
            session_ = std::move(next);
            broken_ = false;
            ++status_.builds;
            reports_.clear();
            stale_.clear();
            rereadScene_ = false;
            status_.framesStill = 0;
            status_.wallMilliseconds = 0;
            if (shown_.empty()) shown_ = session_->graph().nameOf(session_->graph().show);
            describe();
            const double milliseconds = millisecondsSince(start);
            askA([&](LiveSide& a) {
                a.reset();
                a.frame(*session_, report.frame, captures_);
            });
            took(report, milliseconds);
        } catch (const Error&) {
            given_ = given;
            set_ = set;
            shown_ = shown;
            throw;
        }
    });
    status_.busy.clear();
    watchFiles();
    tell();
    if (built) compareFirst();
    return built;
}

bool ViewSession::wantsFrame() const { return session_ && !broken_ && (!status_.paused || stepping_); }

void ViewSession::frame() {
    stepping_ = false;
    try {
        const auto begin = Clock::now();
        askA([&](LiveSide& a) { a.frame(*session_, session_->runner().nextFrame(), captures_); });
        const auto start = Clock::now();
        const FrameReport report = session_->runner().run();
        const double ofBoth = millisecondsSince(begin);
        took(report, millisecondsSince(start));
        if (const auto size = frameSize_ ? frameSize_->took(ofBoth) : std::nullopt) resize(*size);
    } catch (const Error& error) {
        broken_ = true;  // the frame is half done: only a new session goes on
        attempt([&] { throw error; });
    }
    tell();
}

void ViewSession::took(const FrameReport& report, double wallMilliseconds) {
    if (reports_.size() == framesRemembered) reports_.erase(reports_.begin());
    reports_.push_back(report);
    ++status_.framesDone;
    ++status_.framesStill;
    status_.nextFrame = session_->runner().nextFrame();
    if (status_.passes.size() != report.passes.size()) status_.passes.assign(report.passes.size(), {});
    double device = 0;
    for (std::size_t i = 0; i < report.passes.size(); ++i) {
        const PassReport& pass = report.passes[i];
        PassTime& time = status_.passes[i];
        if (time.name != pass.name) time = {.name = pass.name};
        time.ran = pass.ran;
        time.runs += pass.ran;
        time.setup = pass.setup;
        if (pass.ran) smooth(time.milliseconds, pass.milliseconds);
        time.history.clear();
        for (const FrameReport& frame : reports_)
            if (frame.passes[i].ran && !pass.setup) time.history.push_back(float(frame.passes[i].milliseconds));
        time.rays = pass.rays;
        if (!pass.setup) device += time.milliseconds;
    }
    status_.deviceMilliseconds = device;
    smooth(status_.wallMilliseconds, wallMilliseconds);
    const CameraKey camera = session_->scene().cameraAt(poseFrame(report.frame));
    if (!sameView(camera, lastCamera_)) status_.framesStill = 1;
    lastCamera_ = camera;
    status_.camera = {camera, scenePath_.has_value()};
    if (status_.framesStill == 1) sides_.restartErrors();
    lookAtScene();
    capture();
}

void ViewSession::capture() {
    const auto& ports = status_.graph->ports;
    const auto port = std::ranges::find(ports, shown_, &PortInfo::name);
    status_.picture = port == ports.end() ? Picture() : captures_.take(session_->runner(), *port, lastCamera_);
    if (!status_.picture.texels) return;
    status_.statistics.reset();
    const glm::uvec2 extent = status_.picture.extent;
    if (statistics_) status_.statistics = statisticsOf(captures_.bytesOf(status_.picture), std::size_t(extent.x) * extent.y, layout_, pick_);
    measure(status_.paused);
}

void ViewSession::describe() {
    auto info = std::make_shared<GraphInfo>();
    const Graph& graph = session_->graph();
    info->file = graph.description.file;
    info->about = graph.description.about;
    info->scene = graph.description.scene.filename().string();
    info->device = device_->facts().name;
    info->rays = nameOf(session_->rays());
    info->variants = graph.description.variants;
    info->variant = options_.changes.variant.value_or("");
    info->show = graph.nameOf(graph.show);
    info->size = session_->runner().size();
    info->memoryBytes = session_->runner().memoryBytes();
    info->software = device_->facts().type == "cpu";
    info->bounds = session_->scene().bounds();
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        const GraphNode& node = graph.nodes[n];
        PassInfo pass{.name = node.name, .type = node.type, .doc = node.plugin->doc, .off = node.off};
        pass.canBeOff = !node.pass->bypasses.empty();
        pass.isScene = node.type == "scene";
        pass.culled = session_->runner().plan().stepOf(int(n)) < 0;
        for (const Parameter* parameter : node.pass->parameters) {
            pass.parameters.push_back(*parameter);
            pass.given.push_back(given_[node.name + "." + std::string(parameter->name)]);
        }
        info->passes.push_back(std::move(pass));
        if (node.off) continue;
        for (std::size_t p = 0; p < node.pass->ports.size(); ++p) {
            const Port& port = *node.pass->ports[p];
            if (port.isInput() || port.role == Port::Role::scratch || port.type.kind == PortType::Kind::handle) continue;
            info->ports.push_back(describePort(graph, session_->runner(), {int(n), int(p), false}));
        }
    }
    describeWires(*info);
    describeEdits(*info);
    describeScene(info->contents);
    status_.graph = std::move(info);
}

void ViewSession::describeWires(GraphInfo& info) const {
    const Graph& graph = session_->graph();
    const auto describeWire = [](const Wire& wire) {
        const auto kind = wire.bundle ? WireInfo::Kind::buffer : WireInfo::Kind(wire.port().type.kind);
        return WireInfo{std::string(wire.name()), wire.typeText(), std::string(wire.doc()), kind, wire.port().optional, wire.first, {}};
    };
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        for (const Wire& wire : wiresOf(*graph.nodes[n].pass, isMade)) {
            WireInfo output = describeWire(wire);
            for (int i = 0; i < wire.count; ++i) output.ports.push_back(graph.nameOf({int(n), wire.first + i}));
            info.passes[n].outputs.push_back(std::move(output));
        }
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        for (const Wire& wire : wiresOf(*graph.nodes[n].pass, isInput)) {
            info.passes[n].inputs.push_back(describeWire(wire));
            const std::optional<Feed> feed = feedOf(graph, int(n), wire);
            if (!feed) continue;
            const Pass& maker = *graph.nodes[std::size_t(feed->node)].pass;
            const std::vector<Wire> outputs = wiresOf(maker, isMade);
            const auto output = std::ranges::find(outputs, wireOf(maker, feed->output.first).first, &Wire::first);
            info.edges.push_back(
                {feed->node, int(output - outputs.begin()), int(n), int(info.passes[n].inputs.size()) - 1, feed->prev, feed->written});
        }
}

void ViewSession::describeEdits(GraphInfo& info) const {
    const Graph& graph = session_->graph();
    for (const PassType& type : types_) info.edits.types.push_back({type.type, type.doc, questionsOf(graph, type)});
    for (std::size_t n = 0; n < graph.nodes.size() && !types_.empty(); ++n) {
        info.edits.swaps.emplace_back();
        for (std::size_t t = 0; t < types_.size(); ++t)
            if (swapPatch(graph, int(n), types_[t])) info.edits.swaps.back().push_back(t);
        info.edits.offers.emplace_back();
        for (const Wire& input : wiresOf(*graph.nodes[n].pass, isInput))
            info.edits.offers.back().push_back(offersFor(graph, int(n), input));
    }
}

void ViewSession::watchFiles() {
    std::set<Path> files{std::filesystem::absolute(options_.graph)};
    if (session_) {
        for (const Path& file : session_->runner().shaderFiles()) files.insert(file);
        if (sides_.live())
            for (const Path& file : sides_.live()->shaderFiles()) files.insert(file);
        files.insert(session_->scene().file);
        for (const GraphNode& node : session_->graph().nodes) {
            if (!*node.plugin->shader) continue;
            try {
                const gpu::IncludeClosure closure(shaderOf(*node.plugin, node.plugin->shader), includeFolders(*node.plugin), {});
                for (const Path& file : closure.files()) files.insert(file);
            } catch (const Error&) {  // not there just now: noticed through the graph
            }
        }
    }
    for (const std::string& problem : status_.problems) {  // a file that kept a session from being built
        const Path file = problem.substr(0, problem.find(':'));
        std::error_code unknown;
        if (std::filesystem::is_regular_file(file, unknown)) files.insert(file);
    }
    watch_.watch({files.begin(), files.end()});
}

void ViewSession::reloadChanged() {
    const std::vector<Path> changed = watch_.changed();
    if (changed.empty()) return;
    const auto isShader = [&](const Path& file) {
        return file.extension() != ".json" && file != std::filesystem::absolute(options_.graph) && (!session_ || file != session_->scene().file);
    };
    if (session_ && std::ranges::find(changed, session_->scene().file) != changed.end()) rereadScene_ = true;
    if (!session_ || broken_ || !std::ranges::all_of(changed, isShader)) {
        build();
        return;
    }

    stale_.insert(stale_.end(), changed.begin(), changed.end());
    status_.busy = "compiling shaders";
    tell();
    attempt([&] {
        asking_.reset();
        const int anew = session_->runner().reloadShaders(stale_) + (sides_.live() ? sides_.live()->reloadShaders(stale_) : 0);
        if (anew > 0) {
            resetBoth();
            status_.framesStill = 0;
        }
        ++status_.reloads;
        stale_.clear();
    });
    status_.busy.clear();
    watchFiles();
    tell();
}

/// A frame is wanted even while paused.
void ViewSession::changedByHand(bool restarts) {
    if (restarts) status_.framesStill = 0;
    stepping_ = true;
    if (broken_) build();
}

void ViewSession::pause(bool paused) {
    status_.paused = paused;
    measure(paused);
    tell();
}

void ViewSession::step() { stepping_ = true; }

void ViewSession::resetHistory() {
    if (!session_) return;
    resetBoth();
    changedByHand(true);
}

void ViewSession::setFrame(std::uint32_t frame) {
    if (!session_) return;
    session_->runner().setFrame(frame);
    changedByHand(true);
}

void ViewSession::setCamera(const CameraKey& camera) {
    if (!session_) return;
    CameraPath& path = session_->sharedScene()->camera;
    if (!scenePath_) scenePath_ = path;
    path = {.keys = {camera}};
    changedByHand(true);
}

void ViewSession::resetCamera() {
    if (!session_ || !scenePath_) return;
    session_->sharedScene()->camera = *scenePath_;
    scenePath_.reset();
    changedByHand(true);
}

void ViewSession::setParameter(const std::string& name, const Value& value) { setParameter(name, name, value); }

void ViewSession::setParameter(const std::string& what, const std::string& name, const Value& value) {
    const auto given = given_.find(name);
    if (!session_ || given == given_.end()) return;
    const HandMade before = handMade();
    HandMade wanted = before;
    if (value == given->second) wanted.set.erase(name);
    else wanted.set[name] = value;
    if (wanted.set != before.set && become(wanted)) history_.did(what, before);
}

void ViewSession::setVariant(const std::string& variant) {
    const HandMade before = handMade();
    HandMade wanted = before;
    wanted.variant = variant.empty() ? std::nullopt : std::optional(variant);
    if (become(wanted)) history_.did(variant.empty() ? "the graph as written" : "variant " + variant, before);
    tell();
}

/// Sets the parameters of the running session as they are by hand; true where it takes another session for that.
bool ViewSession::apply(const std::map<std::string, Value>& set) {
    bool builds = false;
    const std::set<std::string> facts = graphFacts(session_->graph(), session_->scene());
    for (const GraphNode& node : session_->graph().nodes)
        for (Parameter* parameter : node.pass->parameters) {
            const std::string name = node.name + "." + std::string(parameter->name);
            const auto byHand = set.find(name);
            const Value& value = byHand == set.end() ? given_[name] : byHand->second;
            if (value == parameter->value) continue;
            if (parameter->constant) builds = true;
            else parameter->value = value;
        }
    return builds || graphFacts(session_->graph(), session_->scene()) != facts;
}

/// Makes the graph differ from its file as is wanted; false where it can't be built, and all is as it was.
bool ViewSession::become(const HandMade& wanted) {
    const HandMade before = handMade();
    const auto given = given_;
    const bool otherGraph = !session_ || broken_ || wanted.variant != before.variant || wanted.patches.size() != before.patches.size();
    options_.changes.variant = wanted.variant;
    options_.changes.patches = wanted.patches;
    options_.changes.set = wanted.settings;
    set_ = wanted.set;
    if (!otherGraph && !apply(set_)) {
        if (sides_.live()) resetBoth();
        changedByHand(true);
        return true;
    }
    if (wanted.set != before.set) given_.clear();  // it holds, whatever the other graph says
    if (build()) return true;
    options_.changes.variant = before.variant;
    options_.changes.patches = before.patches;
    options_.changes.set = before.settings;
    set_ = before.set;
    given_ = given;
    if (session_) {
        apply(set_);
        describe();
    }
    return false;
}

void ViewSession::resize(glm::uvec2 size) {
    const auto before = options_.changes.size;
    options_.changes.size = size;
    if (!session_ || broken_) {
        build();
        return;
    }
    asking_.reset();
    if (!attempt([&] { session_->runner().resize(size); })) {  // memory is out, and what there was is gone
        options_.changes.size = before;
        frameSize_.reset();
        const std::vector<std::string> problems = status_.problems;
        build();
        status_.problems.insert(status_.problems.begin(), problems.begin(), problems.end());
        tell();
        return;
    }
    session_->graph().description.size = size;
    reports_.clear();
    status_.wallMilliseconds = 0;
    describe();
    changedByHand(true);
    tell();
}

void ViewSession::followTime(double milliseconds, glm::uvec2 window) {
    frameSize_.reset();
    if (!session_ || milliseconds <= 0 || window.x == 0 || window.y == 0) return;
    frameSize_.emplace(milliseconds, window, session_->runner().size());
}

void ViewSession::open(const Path& file) {
    const std::string ending = file.extension().string(), name = file.filename().string();
    if (ending != ".json" && ending != ".glb" && ending != ".gltf") return compareWithImage(file);
    const GraphOptions changes = options_.changes;
    const Path graph = options_.graph;
    const std::map<std::string, Value> set = set_, given = given_;
    const std::string shown = shown_;
    const bool done = attempt([&] {
        if (ending == ".json" && Json::load(file).find("passes")) {
            options_.graph = file;
            options_.changes = {.scene = changes.scene, .frames = {}, .size = changes.size, .seed = changes.seed, .set = {}, .variant = {}, .show = {}};
            set_.clear();
            given_.clear();
            shown_.clear();
        } else {
            options_.changes.scene = file;
        }
    }) && build();
    if (done) {
        if (options_.graph != graph) history_ = {};
    } else {
        options_.graph = graph;
        options_.changes = changes;
        set_ = set;
        given_ = given;
        shown_ = shown;
        status_.refused = name;
        watchFiles();
    }
    tell();
}

const PassType& ViewSession::typeNamed(const std::string& type) const {
    const auto found = std::ranges::find(types_, type, &PassType::type);
    if (found == types_.end()) throw Error("no pass type \"" + type + "\"");
    return *found;
}

/// `replaced`: the pass that isn't the same any more, whose parameters are the patch's matter.
void ViewSession::edit(const std::string& what, const std::string& replaced, const std::function<Json(const Graph&)>& patch) {
    if (!session_) return;
    const HandMade before = handMade();
    HandMade wanted = before;
    std::erase_if(wanted.set, [&](const auto& set) { return set.first.starts_with(replaced + "."); });
    std::erase_if(wanted.settings, [&](const Setting& setting) { return setting.name.starts_with(replaced + "."); });
    const bool done = attempt([&] { wanted.patches.push_back(patch(session_->graph())); }) && become(wanted);
    if (done) history_.did(what, before);
    else status_.refused = what;
    tell();
}

void ViewSession::turnPass(const std::string& pass, bool off) {
    edit(pass + (off ? " off" : " on"), "", [&](const Graph&) { return turnPatch(pass, off); });
}

void ViewSession::removePass(const std::string& pass) {
    edit("without " + pass, pass, [&](const Graph& graph) { return removalPatch(graph, graph.find(pass)); });
}

void ViewSession::swapPass(const std::string& pass, const std::string& type) {
    edit(pass + " as " + type, pass, [&](const Graph& graph) {
        const std::optional<Json> patch = swapPatch(graph, graph.find(pass), typeNamed(type));
        if (!patch) throw Error("pass \"" + pass + "\" can't be " + type);
        return *patch;
    });
}

void ViewSession::addPass(const std::string& type, const std::map<std::string, std::string>& answers) {
    edit("one more " + type, "", [&](const Graph& graph) { return additionPatch(graph, typeNamed(type), answers); });
}

void ViewSession::wireInput(const std::string& pass, const std::string& input, const std::string& from) {
    edit(pass + "." + input + (from.empty() ? " unwired" : " from " + from), "", [&](const Graph&) { return wirePatch(pass, input, from); });
}

void ViewSession::undo() {
    if (history_.undoable().empty()) return;
    const HandMade before = handMade(), wanted = history_.beforeLast();
    const auto described = status_.graph;
    if (become(wanted)) history_.undid(before);
    if (status_.graph == described) describe();  // parameters were set without another session
    tell();
}

void ViewSession::redo() {
    if (history_.redoable().empty()) return;
    const HandMade before = handMade(), wanted = history_.afterNext();
    const auto described = status_.graph;
    if (become(wanted)) history_.redid(before);
    if (status_.graph == described) describe();
    tell();
}

void ViewSession::dismiss() {
    if (status_.refused.empty()) return;
    status_.refused.clear();
    status_.problems.clear();
    tell();
}

void ViewSession::offerEdits() {
    if (!session_ || !types_.empty()) return;
    Problems unloadable;  // whoever names such a type is told
    PluginLibraries libraries(options_.renderer.passes);
    for (const auto& [type, plugin] : libraries.all(unloadable))
        if (type != "scene") types_.push_back(makePassType(type, *plugin));
    describe();
    tell();
}

void ViewSession::show(const std::string& port, const TexelLayout& layout, std::uint32_t pick, bool statistics) {
    const bool other = port != shown_;
    shown_ = port;
    layout_ = layout;
    pick_ = pick;
    statistics_ = statistics;
    if (!session_) return;
    const auto found = std::ranges::find(status_.graph->ports, port, &PortInfo::name);
    if (other && (found == status_.graph->ports.end() || !found->runs)) {
        build();
        return;
    }
    if (broken_) return;
    capture();
    tell();
}

/// What was done last, for the window and the log.
void ViewSession::noteDone(const std::string& what) {
    status_.note = what;
    log::note("{}", what);
}

void ViewSession::save(const Path& folder) {
    if (!session_) return;
    attempt([&] {
        const Source source = findSource(session_->graph(), shown_);
        const Path path = folder / fmt::format("{}.{}", shown_, status_.nextFrame - 1);
        dumpPort(session_->graph(), session_->runner(), source, path);
        const bool image = session_->graph().port(source).type.kind == PortType::Kind::image;
        if (image) writePng(path.string() + ".png", preview(session_->runner().readImage(source)));
        if (status_.a.kind == SideA::Kind::live && status_.a.picture.texels) sides_.live()->save(folder);
        noteDone(fmt::format("wrote {}{}", path.string(), image ? ".exr and .png" : ".npy"));
    });
    tell();
}

void ViewSession::saveTimes(const Path& folder) {
    if (!session_) return;
    attempt([&] {
        writeFile(folder / "times.csv", timesCsv(reports_));
        writeFile(folder / "trace.json", traceJson(reports_, status_.graph->device).dump() + "\n");
        noteDone(fmt::format("wrote {}: {} frames; trace.json beside it", (folder / "times.csv").string(), reports_.size()));
    });
    tell();
}

void ViewSession::saveGraph(const Path& file) {
    if (!session_) return;
    attempt([&] {
        writeFile(file, session_->graph().resolved().dump(2) + "\n");
        noteDone("wrote " + file.string());
    });
    tell();
}

void ViewSession::saveIntoGraph() {
    if (!session_) return;
    attempt([&] {
        GraphOptions changes = options_.changes;
        for (const GraphNode& node : session_->graph().nodes)
            for (const Parameter* parameter : node.pass->parameters) {
                const std::string name = node.name + "." + std::string(parameter->name);
                if (set_.contains(name)) changes.set.push_back({name, writeValue(*parameter, parameter->value)});
            }
        const Path& file = session_->graph().description.file;
        writeFile(file, textWithChanges(readText(file), file, changes));
        options_.changes.patches.clear();
        options_.changes.set.clear();
        set_.clear();
        history_ = {};
        noteDone("wrote into " + file.string());
    });
    tell();  // reloadChanged() sees to the rest
}

}  // namespace lodestir
