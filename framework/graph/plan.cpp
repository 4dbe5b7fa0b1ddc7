// SPDX-License-Identifier: MIT
// Orders the passes, finds how long their memory lives, and places as few barriers as keep apart what must be.
#include <framework/graph/plan.h>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace lodestir {
namespace {

/// One step touching one piece of memory.
struct Access {
    int memory;  ///< equal numbers: the same memory
    int resource;
    bool write;
};

/// Two accesses that need a barrier between: after step `from`, at or before step `to` (of the next frame where `wraps`).
struct Need {
    int from, to;
    bool wraps;
    Access before, after;
};

class Planner {
public:
    Planner(const Graph& graph, const std::vector<Source>& pinned, const PlanOptions& options)
        : graph_(graph), options_(options), pinned_(pinned) {
        pinned_.push_back(graph.show);
        if (options_.frame == glm::uvec2(0)) options_.frame = graph.description.size;
    }

    Plan make() {
        findNeeded();
        orderSteps();
        listResources();
        shareMemory();
        placeBarriers();
        return std::move(plan_);
    }

private:
    const GraphNode& node(int index) const { return graph_.nodes[std::size_t(index)]; }

    void findNeeded() {
        needed_.assign(graph_.nodes.size(), false);
        std::vector<int> open;
        for (const Source& source : pinned_) open.push_back(source.node);
        while (!open.empty()) {
            const int index = open.back();
            open.pop_back();
            if (needed_[std::size_t(index)]) continue;
            needed_[std::size_t(index)] = true;
            for (const auto& input : node(index).inputs) {
                if (input) open.push_back(input->node);
            }
        }
        for (std::size_t i = 0; i < needed_.size(); ++i) {
            if (!needed_[i]) plan_.culled.push_back(int(i));
        }
    }

    /// Must `first` come before `second` in a frame? It makes what second reads, or reads the state that second is about to change.
    bool comesBefore(int first, int second) const {
        for (const auto& input : node(second).inputs) {
            if (input && !input->prev && input->node == first) return true;
        }
        for (const auto& input : node(first).inputs) {
            if (input && input->prev && input->node == second && first != second && isState(*input)) return true;
        }
        return false;
    }
    bool isState(const Source& source) const { return graph_.port(source).role == Port::Role::state; }

    /// Of what could run next, always the one that stands first in the file.
    void orderSteps() {
        std::vector<int> left;
        for (std::size_t i = 0; i < needed_.size(); ++i) {
            if (needed_[i]) left.push_back(int(i));
        }
        while (!left.empty()) {
            const auto isReady = [&](int index) {
                return std::ranges::none_of(left, [&](int other) { return other != index && comesBefore(other, index); });
            };
            const auto next = std::ranges::find_if(left, isReady);
            if (next == left.end()) throw Error("the graph has a cycle; it was not made by buildGraph");
            plan_.steps.push_back({*next, node(*next).pass->cadence == Cadence::onChange, {}});
            left.erase(next);
        }
    }

    void listResources() {
        const int last = int(plan_.steps.size()) - 1;
        for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
            if (!needed_[i]) continue;
            for (std::size_t p = 0; p < node(int(i)).pass->ports.size(); ++p) {
                const Port& port = *node(int(i)).pass->ports[p];
                if (port.isInput()) continue;
                PlanResource r{.node = int(i), .port = int(p)};
                r.firstStep = r.lastStep = plan_.stepOf(int(i));
                r.pinned = std::ranges::any_of(pinned_, [&](const Source& s) { return s.node == r.node && s.port == r.port; });
                r.keeps =
                    port.role == Port::Role::state || (port.role == Port::Role::out && node(int(i)).pass->cadence == Cadence::onChange);
                bool isRead = r.pinned;
                for (std::size_t s = 0; s < plan_.steps.size(); ++s) isRead = followReader(int(s), r, port) || isRead;
                if (port.optional && !isRead && !options_.keepAll) continue;
                if (r.keeps) r.firstStep = 0;
                if (r.keeps || r.pinned) r.lastStep = last;
                plan_.resources.push_back(r);
            }
        }
    }

    /// Does the step read it?
    bool followReader(int step, PlanResource& r, const Port& port) const {
        bool reads = false;
        for (const auto& input : node(plan_.steps[std::size_t(step)].node).inputs) {
            if (!input || input->node != r.node || input->port != r.port) continue;
            reads = true;
            if (!input->prev) r.lastStep = std::max(r.lastStep, step);
            if (!input->prev || port.role == Port::Role::state) continue;
            r.history = r.keeps = true;
            // The CPU writes handles while last frame's are in use.
            if (port.type.kind == PortType::Kind::handle || step >= plan_.stepOf(r.node)) r.copies = 2;
        }
        return reads;
    }

    /// Resources that lie in one place, one made over the other, and how long they live together.
    struct Piece {
        std::vector<int> resources;
        int firstStep, lastStep;
        std::size_t bytes;
    };

    /// The resource over which `r` may be written, -1: none. Its content must not be needed after the step that makes r, nor r's before it.
    int overwrittenBy(const PlanResource& r) const {
        if (r.keeps || options_.keepAll) return -1;
        const GraphNode& n = node(r.node);
        for (const Pass::Bypass& over : n.pass->overwrites) {
            if (over.out != n.pass->ports[std::size_t(r.port)]) continue;
            const auto& source = n.inputs[std::size_t(std::ranges::find(n.pass->ports, over.in) - n.pass->ports.begin())];
            if (!source || source->prev || std::ranges::count(n.inputs, source) > 1) continue;
            const int found = plan_.resourceOf(source->node, source->port);
            const PlanResource& q = plan_.resources[std::size_t(found)];
            const bool isAlike = graph_.port(*source).format == over.out->format && bytesOf(found) == bytesOf(plan_.resourceOf(r.node, r.port));
            if (isAlike && !q.keeps && !q.pinned && q.lastStep == plan_.stepOf(r.node)) return found;
        }
        return -1;
    }
    std::size_t bytesOf(int resource) const {
        const PlanResource& r = plan_.resources[std::size_t(resource)];
        return lodestir::bytesOf(graph_, r.node, r.port, options_.frame);
    }

    /// What lies over what, one chain after the other.
    std::vector<Piece> findPieces() const {
        const std::size_t count = plan_.resources.size();
        std::vector<int> over(count), under(count, -1);
        for (std::size_t i = 0; i < count; ++i) {
            over[i] = overwrittenBy(plan_.resources[i]);
            if (over[i] >= 0) under[std::size_t(over[i])] = int(i);
        }
        std::vector<Piece> pieces;
        for (std::size_t i = 0; i < count; ++i) {
            if (over[i] >= 0) continue;
            Piece piece{{}, plan_.resources[i].firstStep, plan_.resources[i].lastStep, bytesOf(int(i))};
            for (int at = int(i); at >= 0; at = under[std::size_t(at)]) {
                piece.resources.push_back(at);
                piece.lastStep = plan_.resources[std::size_t(at)].lastStep;
            }
            pieces.push_back(std::move(piece));
        }
        return pieces;
    }

    bool canShare(int resource) const {
        const PlanResource& r = plan_.resources[std::size_t(resource)];
        const Port& port = graph_.port({r.node, r.port});
        return !r.keeps && port.type.kind != PortType::Kind::handle && port.count.kind != Count::Kind::reserved;
    }

    /// First fit, the big ones first; with `sharing` pieces share memory when no step lies in both lifetimes.
    void shareMemory() {
        std::vector<Piece> pieces = findPieces();
        std::ranges::stable_sort(pieces, std::ranges::greater(), &Piece::bytes);
        std::vector<std::vector<Piece>> groups;
        for (const Piece& piece : pieces) {
            const auto shares = [&](const Piece& p) { return options_.sharing && std::ranges::all_of(p.resources, [&](int i) { return canShare(i); }); };
            const auto fits = [&](const std::vector<Piece>& group) {
                return shares(piece) && std::ranges::all_of(group, [&](const Piece& o) {
                    return shares(o) && (piece.lastStep < o.firstStep || o.lastStep < piece.firstStep);
                });
            };
            const auto group = std::ranges::find_if(groups, fits);
            group == groups.end() ? groups.push_back({piece}) : group->push_back(piece);
        }
        for (const std::vector<Piece>& group : groups) {
            if (group.size() == 1 && group[0].resources.size() == 1) continue;
            for (const Piece& piece : group)
                for (const int i : piece.resources) plan_.resources[std::size_t(i)].group = plan_.groups;
            ++plan_.groups;
        }
    }

    /// Copy 0 or 1 of a resource with history; even and odd frames swap them.
    int memoryOf(int resource, bool otherCopy) const {
        const PlanResource& r = plan_.resources[std::size_t(resource)];
        return r.group >= 0 ? -1 - r.group : 2 * resource + (r.copies == 2 && otherCopy ? 1 : 0);
    }

    std::vector<Access> accessesOf(int step, bool oddFrame) const {
        std::vector<Access> accesses;
        const int index = plan_.steps[std::size_t(step)].node;
        const GraphNode& n = node(index);
        for (std::size_t p = 0; p < n.inputs.size(); ++p) {
            if (n.pass->ports[p]->isInput()) {
                if (!n.inputs[p]) continue;
                const int r = plan_.resourceOf(n.inputs[p]->node, n.inputs[p]->port);
                accesses.push_back({memoryOf(r, oddFrame != n.inputs[p]->prev), r, false});
            } else {
                const int r = plan_.resourceOf(index, int(p));
                if (r >= 0) accesses.push_back({memoryOf(r, oddFrame), r, true});
            }
        }
        return accesses;
    }

    /// Every pair of accesses that must be kept apart, within a frame and from one frame to the next. (Each step writes something, so each
    /// frame has a barrier, and what lies two frames apart is kept apart by it.)
    std::vector<Need> findNeeds() const {
        const int count = int(plan_.steps.size());
        std::vector<Need> needs;
        for (int from = 0; from < count; ++from) {
            for (int to = 0; to < count; ++to) {
                for (const bool wraps : {false, true}) {
                    if (wraps ? to > from : to <= from) continue;  // a wrap to a later step passes all steps: any barrier will do
                    addNeeds(from, to, wraps, needs);
                }
            }
        }
        return needs;
    }

    void addNeeds(int from, int to, bool wraps, std::vector<Need>& needs) const {
        const std::vector<Access> before = accessesOf(from, false), after = accessesOf(to, wraps);
        for (const Access& a : before) {
            for (const Access& b : after) {
                if (a.memory == b.memory && (a.write || b.write)) needs.push_back({from, to, wraps, a, b});
            }
        }
    }

    static bool isMet(const Need& need, const std::vector<bool>& barriers) {
        const int count = int(barriers.size());
        const int end = need.wraps ? need.to + count : need.to;
        for (int k = need.from + 1; k <= end; ++k) {
            if (barriers[std::size_t(k % count)]) return true;
        }
        return false;
    }

    void placeBarriers() {
        const std::vector<Need> needs = findNeeds();
        std::vector<bool> barriers(plan_.steps.size(), options_.allBarriers);
        // As late as possible, so that one barrier serves many needs; then those that later ones made superfluous go.
        std::vector<const Need*> byEnd;
        for (const Need& need : needs) byEnd.push_back(&need);
        std::ranges::stable_sort(byEnd, {}, [](const Need* need) { return std::pair(need->wraps, need->to); });
        for (const Need* need : byEnd) {
            if (!isMet(*need, barriers)) barriers[std::size_t(need->to)] = true;
        }
        for (std::size_t k = 0; k < barriers.size() && !options_.allBarriers; ++k) {
            if (!barriers[k]) continue;
            barriers[k] = false;
            barriers[k] = !std::ranges::all_of(needs, [&](const Need& need) { return isMet(need, barriers); });
        }
        for (std::size_t k = 0; k < barriers.size(); ++k) {
            if (barriers[k]) plan_.steps[k].barrier = reasonFor(int(k), needs, barriers);
        }
    }

    /// A need that no other barrier meets, preferably one that ends at this step and in this frame.
    std::string reasonFor(int step, const std::vector<Need>& needs, std::vector<bool> barriers) const {
        barriers[std::size_t(step)] = false;
        const Need* best = nullptr;
        const auto rank = [&](const Need& need) { return std::pair(need.to != step, need.wraps); };
        for (const Need& need : needs) {
            if (!isMet(need, barriers) && (!best || rank(need) < rank(*best))) best = &need;
        }
        return best ? describe(*best, step) : "every step has one";
    }

    std::string describe(const Need& need, int step) const {
        const auto name = [&](const Access& access) {
            const PlanResource& r = plan_.resources[std::size_t(access.resource)];
            return graph_.nameOf({r.node, r.port});
        };
        const auto stepName = [&](int index) {
            return fmt::format("step {} ({})", index + 1, node(plan_.steps[std::size_t(index)].node).name);
        };
        const std::string subject = need.to == step ? std::string() : stepName(need.to) + " ";
        const std::string sharing =
            need.before.resource == need.after.resource ? std::string() : fmt::format(" into the memory of {}", name(need.before));
        return fmt::format("{}{} {}{}, {} by {}{}", subject, need.after.write ? "writes" : "reads", name(need.after), sharing,
                           need.before.write ? "written" : "read", stepName(need.from), need.wraps ? " of the frame before" : "");
    }

    const Graph& graph_;
    PlanOptions options_;
    std::vector<Source> pinned_;
    std::vector<bool> needed_;
    Plan plan_;
};

}  // namespace

int Plan::stepOf(int node) const {
    const auto found = std::ranges::find(steps, node, &PlanStep::node);
    return found == steps.end() ? -1 : int(found - steps.begin());
}

int Plan::resourceOf(int node, int port) const {
    const auto found = std::ranges::find_if(resources, [&](const PlanResource& r) { return r.node == node && r.port == port; });
    return found == resources.end() ? -1 : int(found - resources.begin());
}

Plan makePlan(const Graph& graph, const std::vector<Source>& pinned, const PlanOptions& options) {
    return Planner(graph, pinned, options).make();
}

std::size_t planBytes(const Plan& plan, const Graph& graph, glm::uvec2 frame) {
    std::size_t bytes = 0;
    std::vector<std::size_t> groups(std::size_t(plan.groups), 0);
    for (const PlanResource& r : plan.resources) {
        const std::size_t own = lodestir::bytesOf(graph, r.node, r.port, frame);
        if (r.group >= 0) {
            groups[std::size_t(r.group)] = std::max(groups[std::size_t(r.group)], own);
        } else {
            bytes += own * std::size_t(r.copies);
        }
    }
    return std::accumulate(groups.begin(), groups.end(), bytes);
}

}  // namespace lodestir
