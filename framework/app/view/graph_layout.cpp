// SPDX-License-Identifier: MIT
#include <framework/app/view/graph_layout.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

namespace lodestir {
namespace {

constexpr float gutter = 42;  // between columns, where edges bend
constexpr float track = 7;    // between lines that run side by side
constexpr float boxGap = 16, trunkHeight = 6, trunkGap = 5;
constexpr int sweeps = 24;  // over the columns, there and back

class Layout {
public:
    Layout(std::span<const LayoutBox> boxes, std::span<const LayoutEdge> edges) : boxes_(boxes), edges_(edges), back_(edges.size()) {}

    GraphLayout make() {
        findColumns();
        makeItems();
        orderRows();
        place();
        route();
        return std::move(result_);
    }

private:
    /// What takes a place in a column: a box, or a trunk that passes.
    struct Item {
        int box = -1;  // -1: a trunk
        float height = trunkHeight, y = 0;
        float wanted = 0;
    };
    struct End {
        int item;
        float height;  // below the item's top
    };
    /// A piece of an edge, from one column to the next.
    struct Link {
        End from, to;
    };

    /// The longest way from the left; what nothing leads to stands just before what it leads to. Edges that close a circle run back.
    void findColumns() {
        const std::size_t count = boxes_.size();
        columnOf_.assign(count, 0);
        std::vector<int> state(count);  // 1: on the way, 2: done
        const std::function<void(int)> visit = [&](int node) {
            state[std::size_t(node)] = 1;
            for (std::size_t e = 0; e < edges_.size(); ++e) {
                const LayoutEdge& edge = edges_[e];
                if (edge.to != node) continue;
                back_[e] = edge.prev || state[std::size_t(edge.from)] == 1;
                if (back_[e]) continue;
                if (state[std::size_t(edge.from)] == 0) visit(edge.from);
                columnOf_[std::size_t(node)] = std::max(columnOf_[std::size_t(node)], columnOf_[std::size_t(edge.from)] + 1);
            }
            state[std::size_t(node)] = 2;
        };
        for (std::size_t n = 0; n < count; ++n)
            if (state[n] == 0) visit(int(n));
        for (std::size_t n = 0; n < count; ++n) {
            const bool isLed = std::ranges::any_of(range(edges_.size()), [&](std::size_t e) { return !back_[e] && edges_[e].to == int(n); });
            int first = -1;
            for (std::size_t e = 0; e < edges_.size(); ++e)
                if (!back_[e] && edges_[e].from == int(n) && (first < 0 || columnOf_[std::size_t(edges_[e].to)] < first))
                    first = columnOf_[std::size_t(edges_[e].to)];
            if (!isLed && first > 0) columnOf_[n] = first - 1;
        }
        columns_.resize(count == 0 ? 0 : std::size_t(std::ranges::max(columnOf_)) + 1);
    }

    static std::vector<std::size_t> range(std::size_t count) {
        std::vector<std::size_t> all(count);
        std::iota(all.begin(), all.end(), std::size_t(0));
        return all;
    }

    void makeItems() {
        for (std::size_t n = 0; n < boxes_.size(); ++n) {
            columns_[std::size_t(columnOf_[n])].push_back(int(items_.size()));
            items_.push_back({.box = int(n), .height = boxes_[n].size.y});
        }
        // Trunks reach as far as the farthest of an output's consumers.
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (back_[e]) continue;
            const LayoutEdge& edge = edges_[e];
            std::vector<int>& trunk = trunks_[{edge.from, edge.output}];
            for (int c = columnOf_[std::size_t(edge.from)] + 1 + int(trunk.size()); c < columnOf_[std::size_t(edge.to)]; ++c) {
                trunk.push_back(int(items_.size()));
                columns_[std::size_t(c)].push_back(int(items_.size()));
                items_.push_back({});
            }
        }
        for (const auto& [output, trunk] : trunks_) {
            End end{output.first, boxes_[std::size_t(output.first)].outputs[std::size_t(output.second)]};
            for (const int item : trunk) {
                const End next{item, 0.5f * trunkHeight};
                links_.push_back({end, next});
                end = next;
            }
        }
        for (std::size_t e = 0; e < edges_.size(); ++e)
            if (!back_[e]) links_.push_back({lastEnd(edges_[e]), {edges_[e].to, boxes_[std::size_t(edges_[e].to)].inputs[std::size_t(edges_[e].input)]}});
    }

    /// Where an edge leaves the column before its consumer's.
    End lastEnd(const LayoutEdge& edge) const {
        const int passed = columnOf_[std::size_t(edge.to)] - columnOf_[std::size_t(edge.from)] - 1;
        if (passed == 0) return {edge.from, boxes_[std::size_t(edge.from)].outputs[std::size_t(edge.output)]};
        return {trunks_.at({edge.from, edge.output})[std::size_t(passed) - 1], 0.5f * trunkHeight};
    }

    float yOf(const End& end) const { return items_[std::size_t(end.item)].y + end.height; }

    /// The tops that lie nearest to what is wanted, in the column's order and without overlap: pooled as in isotonic regression.
    void settle(const std::vector<int>& column) {
        struct Pool {
            float sum;
            int count;
            float mean() const { return sum / float(count); }
        };
        std::vector<Pool> pools;
        std::vector<float> offsets;
        float offset = 0;
        for (std::size_t i = 0; i < column.size(); ++i) {
            const Item& item = items_[std::size_t(column[i])];
            if (i > 0) {
                const Item& above = items_[std::size_t(column[i - 1])];
                offset += above.height + (above.box < 0 && item.box < 0 ? trunkGap : boxGap);
            }
            offsets.push_back(offset);
            pools.push_back({item.wanted - offset, 1});
            while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
                const Pool last = pools.back();
                pools.pop_back();
                pools.back() = {pools.back().sum + last.sum, pools.back().count + last.count};
            }
        }
        std::size_t i = 0;
        for (const Pool& pool : pools)
            for (int k = 0; k < pool.count; ++k, ++i) items_[std::size_t(column[i])].y = pool.mean() + offsets[i];
    }

    /// Each item of a column wants to be level with what it is linked to: at its left, at its right, or both.
    void want(const std::vector<int>& column, bool left, bool right) {
        for (const int i : column) {
            Item& item = items_[std::size_t(i)];
            float sum = 0;
            int count = 0;
            for (const Link& link : links_) {
                if (left && link.to.item == i) sum += yOf(link.from) - link.to.height;
                if (right && link.from.item == i) sum += yOf(link.to) - link.from.height;
                count += (left && link.to.item == i) + (right && link.from.item == i);
            }
            item.wanted = count > 0 ? sum / float(count) : item.y;
        }
    }

    int crossings() const {
        int count = 0;
        for (std::size_t a = 0; a < links_.size(); ++a)
            for (std::size_t b = a + 1; b < links_.size(); ++b) {
                if (columnOfItem(links_[a].from.item) != columnOfItem(links_[b].from.item)) continue;
                const float from = yOf(links_[a].from) - yOf(links_[b].from), to = yOf(links_[a].to) - yOf(links_[b].to);
                count += from * to < 0;
            }
        return count;
    }
    int columnOfItem(int item) const { return columnOfItem_[std::size_t(item)]; }

    void orderRows() {
        columnOfItem_.resize(items_.size());
        for (std::size_t c = 0; c < columns_.size(); ++c)
            for (const int item : columns_[c]) columnOfItem_[std::size_t(item)] = int(c);
        for (const std::vector<int>& column : columns_) {
            for (const int item : column) items_[std::size_t(item)].wanted = 0;
            settle(column);
        }
        std::vector<std::vector<int>> best = columns_;
        int fewest = crossings();
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            const bool forward = sweep % 2 == 0;
            for (std::size_t k = 0; k < columns_.size(); ++k) {
                std::vector<int>& column = columns_[forward ? k : columns_.size() - 1 - k];
                want(column, forward, !forward);
                std::ranges::stable_sort(column, {}, [&](int i) { return items_[std::size_t(i)].wanted + 0.5f * items_[std::size_t(i)].height; });
                settle(column);
            }
            const int now = crossings();
            if (now < fewest) {
                fewest = now;
                best = columns_;
            }
        }
        columns_ = best;
    }

    void place() {
        for (const std::vector<int>& column : columns_) {
            for (const int item : column) items_[std::size_t(item)].wanted = 0;
            settle(column);
        }
        for (int sweep = 0; sweep < sweeps; ++sweep)
            for (std::size_t k = 0; k < columns_.size(); ++k) {
                const std::vector<int>& column = columns_[sweep % 2 == 0 ? k : columns_.size() - 1 - k];
                want(column, true, true);
                settle(column);
            }
        float top = 0, bottom = 0;
        for (const Item& item : items_) top = std::min(top, item.y);
        for (Item& item : items_) {
            item.y -= top;
            bottom = std::max(bottom, item.y + item.height);
        }
        lanesTop_ = bottom + boxGap;

        findTracks();
        float x = track * float(tracksIn_[0]);
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            float width = 0;
            for (const int item : columns_[c])
                if (items_[std::size_t(item)].box >= 0) width = std::max(width, boxes_[std::size_t(items_[std::size_t(item)].box)].size.x);
            lefts_.push_back(x);
            rights_.push_back(x + width);
            x += width + track * float(tracksOut_[c]);
            if (c + 1 < columns_.size()) x += gutter + track * float(tracksIn_[c + 1]);
        }
        result_.size = {x, lanesTop_ + track * float(lanes_.size())};
        for (std::size_t n = 0; n < boxes_.size(); ++n) {
            const auto c = std::size_t(columnOf_[n]);
            result_.boxes.push_back({{lefts_[c], items_[n].y}, {rights_[c] - lefts_[c], items_[n].height}});
        }
    }

    /// The lines of last frame's values: one lane an output below all boxes, a track down beside its column, one up beside each consumer's.
    struct Lane {
        int from, output, span = 0;
        int down = 0;           // number of its track beside the producer's column
        std::map<int, int> up;  // and beside consumers' columns
    };
    void findTracks() {
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (!back_[e]) continue;
            const LayoutEdge& edge = edges_[e];
            auto lane = std::ranges::find_if(lanes_, [&](const Lane& l) { return l.from == edge.from && l.output == edge.output; });
            if (lane == lanes_.end()) lane = lanes_.insert(lanes_.end(), Lane{edge.from, edge.output});
            const int column = columnOf_[std::size_t(edge.to)];
            lane->span = std::max(lane->span, std::abs(columnOf_[std::size_t(edge.from)] - column));
            lane->up[column] = 0;
        }
        std::ranges::stable_sort(lanes_, {}, &Lane::span);  // short ones within long ones
        tracksIn_.assign(std::max<std::size_t>(columns_.size(), 1), 0);
        tracksOut_ = tracksIn_;
        for (Lane& lane : lanes_) {
            lane.down = tracksOut_[std::size_t(columnOf_[std::size_t(lane.from)])]++;
            for (auto& [column, number] : lane.up) number = tracksIn_[std::size_t(column)]++;
        }
    }

    void route() {
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const LayoutEdge& edge = edges_[e];
            const auto from = std::size_t(columnOf_[std::size_t(edge.from)]), to = std::size_t(columnOf_[std::size_t(edge.to)]);
            const glm::vec2 start{rights_[from], items_[std::size_t(edge.from)].y + boxes_[std::size_t(edge.from)].outputs[std::size_t(edge.output)]},
                end{lefts_[to], items_[std::size_t(edge.to)].y + boxes_[std::size_t(edge.to)].inputs[std::size_t(edge.input)]};
            GraphLayout::Route route{.back = bool(back_[e]), .points = {start}};
            if (route.back) {
                const auto lane = std::ranges::find_if(lanes_, [&](const Lane& l) { return l.from == edge.from && l.output == edge.output; });
                const float y = lanesTop_ + track * float(lane - lanes_.begin()), down = start.x + track * float(lane->down + 1),
                            up = end.x - track * float(lane->up.at(int(to)) + 1);
                route.points.insert(route.points.end(), {{down, start.y}, {down, y}, {up, y}, {up, end.y}});
            } else {
                const std::vector<int>& trunk = trunks_[{edge.from, edge.output}];
                for (std::size_t c = from + 1; c < to; ++c) {
                    const float y = items_[std::size_t(trunk[c - from - 1])].y + 0.5f * trunkHeight;
                    route.points.push_back({lefts_[c], y});
                    route.points.push_back({rights_[c], y});
                }
            }
            route.points.push_back(end);
            result_.routes.push_back(std::move(route));
        }
    }

    std::span<const LayoutBox> boxes_;
    std::span<const LayoutEdge> edges_;
    std::vector<bool> back_;  // of each edge
    std::vector<int> columnOf_, columnOfItem_;
    std::vector<Item> items_;  // boxes first, in their order
    std::vector<Link> links_;
    std::vector<std::vector<int>> columns_;                   // items from top to bottom
    std::map<std::pair<int, int>, std::vector<int>> trunks_;  // items of each output, from the column after it
    std::vector<Lane> lanes_;
    std::vector<int> tracksIn_, tracksOut_;  // left and right of each column
    std::vector<float> lefts_, rights_;
    float lanesTop_ = 0;
    GraphLayout result_;
};

}  // namespace

GraphLayout layOut(std::span<const LayoutBox> boxes, std::span<const LayoutEdge> edges) { return Layout(boxes, edges).make(); }

}  // namespace lodestir
