// SPDX-License-Identifier: MIT
// An imagined memory: each place remembers who wrote it, who read it since, what it holds, and after how many barriers.
#include <framework/graph/hazards.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace lodestir {
namespace {

constexpr int frames = 8;

/// An onChange pass runs in three frames of four: runs follow runs, pauses follow runs, runs follow pauses.
bool changesIn(int frame) { return frame % 4 != 3; }

struct Moment {
    int frame = -1, step = -1;
    int barriers = -1;  ///< that came before
};

struct Memory {
    Moment written;
    std::vector<Moment> readers;  ///< since it was written
    int resource = -1;            ///< whose value it holds; -1: nobody's
    int version = -1;             ///< the frame that value was made in; -1: cleared
};

struct Copies {
    int current = 0, previous = 0;
    int version = -1, previousVersion = -1;  ///< that readers of the value, and of @prev, are wired to
};

class Simulation {
public:
    Simulation(const Plan& plan, const Graph& graph, std::span<const int> dropped) : plan_(plan), graph_(graph), dropped_(dropped) {
        copies_.resize(plan.resources.size());
        for (std::size_t i = 0; i < plan.resources.size(); ++i) {
            if (plan.resources[i].group >= 0) continue;
            for (const int copy : {0, 1}) memory_[{int(i), copy}].resource = int(i);
        }
    }

    std::vector<Hazard> run() {
        for (int frame = 0; frame < frames; ++frame) {
            for (std::size_t i = 0; i < copies_.size(); ++i) {
                copies_[i].previous = copies_[i].current;
                copies_[i].previousVersion = copies_[i].version;
            }
            for (std::size_t s = 0; s < plan_.steps.size(); ++s) {
                const bool isDropped = std::ranges::find(dropped_, int(s)) != dropped_.end();
                if (!plan_.steps[s].barrier.empty() && !isDropped) ++barriers_;
                if (!plan_.steps[s].onChange || changesIn(frame)) execute({frame, int(s), barriers_});
            }
            readPinned(frame);
        }
        return std::move(hazards_);
    }

private:
    void execute(const Moment& now) {
        const int index = plan_.steps[std::size_t(now.step)].node;
        const GraphNode& node = graph_.nodes[std::size_t(index)];
        for (const auto& input : node.inputs) {
            if (input) readInput(now, plan_.resourceOf(input->node, input->port), input->prev);
        }
        for (std::size_t p = 0; p < node.pass->ports.size(); ++p) {
            const Port& port = *node.pass->ports[p];
            if (port.isInput()) continue;
            const int r = plan_.resourceOf(index, int(p));
            if (r < 0 && port.optional) continue;
            Copies& copies = copies_[std::size_t(r)];
            if (port.role == Port::Role::state) read(now, r, copies.current, copies.version);
            if (plan_.resources[std::size_t(r)].copies == 2) copies.current = 1 - copies.previous;
            copies.version = now.frame;
            write(now, r, copies.current);
        }
    }

    void readInput(const Moment& now, int r, bool prev) {
        if (r < 0) {
            add(Hazard::Kind::wrongContent, now, {}, "reads a value that no step makes");
            return;
        }
        const Copies& copies = copies_[std::size_t(r)];
        const bool other = prev && plan_.resources[std::size_t(r)].copies == 2;
        read(now, r, other ? copies.previous : copies.current, prev ? copies.previousVersion : copies.version);
        // A value of this frame whose maker comes later, or comes never: the version is an old one, though memory and record agree.
        const PlanResource& resource = plan_.resources[std::size_t(r)];
        const bool makerRuns = !plan_.steps[std::size_t(plan_.stepOf(resource.node))].onChange || changesIn(now.frame);
        if (!prev && makerRuns && copies.version != now.frame)
            add(Hazard::Kind::wrongContent, now, {}, "reads " + nameOf(r) + " before it is made");
    }

    /// Whoever looks at a port waits for the frame, so only what it holds matters.
    void readPinned(int frame) {
        for (std::size_t i = 0; i < plan_.resources.size(); ++i) {
            const PlanResource& resource = plan_.resources[i];
            const Memory& memory = memoryOf(int(i), copies_[i].current);
            if (!resource.pinned || (memory.resource == int(i) && memory.version == copies_[i].version)) continue;
            add(Hazard::Kind::wrongContent, {frame, plan_.stepOf(resource.node), barriers_}, memory.written,
                fmt::format("makes {}, which is asked for after the frame, but its memory was overwritten", nameOf(int(i))));
        }
    }

    void read(const Moment& now, int r, int copy, int version) {
        Memory& memory = memoryOf(r, copy);
        if (meets(memory.written, now)) add(Hazard::Kind::readAfterWrite, now, memory.written, fmt::format("reads {}, written", nameOf(r)));
        if (memory.resource != r || memory.version != version) {
            add(Hazard::Kind::wrongContent, now, memory.written,
                fmt::format("reads {} of frame {}, but its memory was overwritten", nameOf(r), version));
        }
        memory.readers.push_back(now);
    }

    void write(const Moment& now, int r, int copy) {
        Memory& memory = memoryOf(r, copy);
        if (meets(memory.written, now))
            add(Hazard::Kind::writeAfterWrite, now, memory.written, fmt::format("writes {}, written", nameOf(r)));
        for (const Moment& reader : memory.readers) {
            if (meets(reader, now)) add(Hazard::Kind::writeAfterRead, now, reader, fmt::format("writes {}, read", nameOf(r)));
        }
        memory = {now, {}, r, now.frame};
    }

    /// Two different executions with no barrier between.
    static bool meets(const Moment& before, const Moment& now) {
        return before.step >= 0 && before.barriers == now.barriers && (before.step != now.step || before.frame != now.frame);
    }

    Memory& memoryOf(int r, int copy) {
        const int group = plan_.resources[std::size_t(r)].group;
        return group >= 0 ? memory_[{-1 - group, 0}] : memory_[{r, copy}];
    }

    std::string nameOf(int r) const { return graph_.nameOf({plan_.resources[std::size_t(r)].node, plan_.resources[std::size_t(r)].port}); }
    std::string stepName(int step) const {
        return fmt::format("step {} ({})", step + 1, graph_.nodes[std::size_t(plan_.steps[std::size_t(step)].node)].name);
    }

    void add(Hazard::Kind kind, const Moment& now, const Moment& before, const std::string& what) {
        std::string text = fmt::format("{} {}", stepName(now.step), what);
        if (before.step >= 0)
            text += fmt::format(" by {}{}", stepName(before.step), before.frame == now.frame ? "" : " of an earlier frame");
        if (known_.emplace(kind, now.step, before.step, what).second) {
            hazards_.push_back({kind, now.frame, now.step, before.frame, before.step, std::move(text)});
        }
    }

    const Plan& plan_;
    const Graph& graph_;
    std::span<const int> dropped_;
    std::vector<Copies> copies_;
    std::map<std::pair<int, int>, Memory> memory_;
    std::set<std::tuple<Hazard::Kind, int, int, std::string>> known_;
    std::vector<Hazard> hazards_;
    int barriers_ = 0;
};

}  // namespace

std::vector<Hazard> findHazards(const Plan& plan, const Graph& graph, std::span<const int> dropped) {
    return Simulation(plan, graph, dropped).run();
}

}  // namespace lodestir
