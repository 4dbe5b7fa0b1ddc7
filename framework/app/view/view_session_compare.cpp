// SPDX-License-Identifier: MIT
// The part of a session that has another side beside what is edited: A, kept or running.
#include <framework/app/view/view_session.h>

#include <framework/app/view/side_study.h>
#include <framework/core/log.h>

namespace lodestir {

/// What runs, to be run by another session: whole, so that whatever becomes of the file, this stays as it is.
SideGraph ViewSession::sideGraph() const {
    return {.file = options_.graph, .made = handMade(), .whole = session_->graph().resolved(), .port = shown_, .layout = layout_};
}

/// A graph as its file has it; of the graph that runs with what the command line sets.
SideGraph ViewSession::sideGraph(const Path& graph, const std::optional<std::string>& variant) const {
    SideGraph side{.file = graph, .made = {.variant = variant, .patches = {}, .settings = {}, .set = {}}, .whole = {}, .port = {}, .layout = {}};
    if (isSameFile(graph, options_.graph)) side.made.settings = options_.changes.set;
    PluginLibraries libraries(options_.renderer.passes);
    const GraphOptions changes{.scene = session_->scene().file, .frames = {}, .size = session_->runner().size(),
                               .seed = session_->graph().description.seed, .set = side.made.settings, .variant = variant, .show = {}};
    side.whole = buildGraph(loadDescription(graph, changes), libraries).resolved();
    return side;
}

/// Both sides begin again, so that neither has more frames behind it.
void ViewSession::startA(SideGraph graph) {
    sides_.run(std::make_unique<LiveSide>(std::move(graph), options_.renderer, device_, compiling()));
    askA([&](LiveSide& a) { a.follow(*session_); });
    resetBoth();
    status_.busy.clear();
    watchFiles();
    changedByHand(true);
    tell();
}

void ViewSession::compareFirst() {
    const ComparedFirst first = std::exchange(first_, {});
    if (!first.image.empty()) sides_.read(first.image, session_->runner().size(), captures_);
    if (!first.graph.empty()) startA(sideGraph(first.graph, first.variant));
    if (!first.graph.empty() && !sides_.live()) throw Error(status_.problems.front());
    measure(true);
    tell();
}

void ViewSession::keepAsA(const Picture& picture, const TexelLayout& layout) {
    if (!session_ || !picture.texels) return;
    SideGraph graph = sideGraph();
    graph.layout = layout;
    sides_.keep(picture, pictureName(options_.graph, options_.changes.variant.value_or(""), picture), std::move(graph));
    measure(true);
    tell();
}

void ViewSession::runAsA() {
    if (session_ && !broken_) startA(sideGraph());
}

void ViewSession::runAsA(const Path& graph, const std::optional<std::string>& variant) {
    if (!session_ || broken_) return;
    std::optional<SideGraph> side;
    if (attempt([&] { side = sideGraph(graph, variant); })) return startA(std::move(*side));
    status_.refused = variant.value_or("the graph as written") + " as A";
    tell();
}

void ViewSession::compareWithImage(const Path& file) {
    if (!session_) return;
    if (!attempt([&] { sides_.read(file, session_->runner().size(), captures_); })) status_.refused = file.filename().string() + " as a reference";
    measure(true);
    tell();
}

void ViewSession::releaseA() {
    sides_.release();
    watchFiles();
    measure(true);
    tell();
}

/// Has A do its part, where it runs. Where it can't, it is let go, and B isn't touched.
void ViewSession::askA(const std::function<void(LiveSide&)>& part) {
    if (!sides_.live()) return;
    try {
        part(*sides_.live());
    } catch (const Error& error) {
        sides_.release();
        for (const Problem& problem : error.problems()) {
            lost_.push_back("A: " + problem.text());
            log::warn("{}", lost_.back());
        }
    }
}

/// What is on the screen, against A; whatever moves on is measured `always` or at a modest rate.
void ViewSession::measure(bool always) { sides_.measure(status_.picture, layout_, pick_, status_.framesStill, always, captures_); }

void ViewSession::resetBoth() {
    session_->runner().reset();
    if (sides_.live()) sides_.live()->reset();
}

void ViewSession::makeStudy(const Path& folder) {
    if (!session_) return;
    const bool done = attempt([&] {
        const SideGraph b = sideGraph();
        const Path file = writeSideStudy({.a = sides_.graph(),
                                          .b = b,
                                          .scene = session_->scene().file,
                                          .camera = scenePath_ ? std::optional(lastCamera_) : std::nullopt,
                                          .size = session_->runner().size(),
                                          .frame = status_.nextFrame - 1,
                                          .framesStill = status_.framesStill,
                                          .passes = options_.renderer.passes},
                                         folder);
        status_.note = "wrote " + file.string();
        log::note("{}; `lodestir study {}` runs it", status_.note, file.string());
    });
    if (!done) status_.refused = "make a study";
    tell();
}

}  // namespace lodestir
