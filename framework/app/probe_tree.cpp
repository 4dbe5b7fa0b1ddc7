// SPDX-License-Identifier: MIT
#include <framework/app/probe_tree.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <set>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson numberOf(const ProbeRecord& record, std::uint32_t i) {
    const std::uint32_t bits = record.numbers[int(i)];
    switch (record.kind) {
    case PROBE_FLOAT: return numberJson(std::bit_cast<float>(bits));
    case PROBE_INT: return std::bit_cast<std::int32_t>(bits);
    case PROBE_BOOL: return bits != 0;
    default: return bits;
    }
}

/// "none|surface|light": word number i, or the number where there are not so many.
OrderedJson wordOf(std::string_view words, std::uint32_t i) {
    for (std::uint32_t n = 0;; ++n) {
        const std::size_t end = words.find('|');
        if (n == i) return std::string(words.substr(0, end));
        if (end == words.npos) return i;
        words.remove_prefix(end + 1);
    }
}

OrderedJson valueOf(const ProbeRecord& record, const ProbeSite& site) {
    if (record.kind == PROBE_WORDS) return site.words;
    if (record.kind == PROBE_CHOICE_OF) return wordOf(site.words, record.numbers.x);
    if (record.count == 1) return numberOf(record, 0);
    OrderedJson vector = OrderedJson::array();
    for (std::uint32_t i = 0; i < record.count; ++i) vector.push_back(numberOf(record, i));
    return vector;
}

/// One invocation's records, one after the other.
class Teller {
public:
    explicit Teller(glm::ivec2 pixel) : root_{{"pixel", {pixel.x, pixel.y}}} { scopes_.push_back({"", &root_, {}}); }

    void take(const ProbeRecord& record, const ProbeSite& site) {
        switch (record.kind) {
        case PROBE_SCOPE:
        case PROBE_SCOPE_AGAIN:
        case PROBE_OBJECT: open(site.name, record.kind); break;
        case PROBE_SCOPE_END: close(site.name); break;
        case PROBE_ITEM_END: scopes_.resize(1); break;
        default: add(site.name, valueOf(record, site));
        }
    }
    OrderedJson& root() { return root_; }

private:
    struct Scope {
        std::string name;
        OrderedJson* object;
        std::set<std::string> repeated;
    };

    // A scope's object lies in its parent's, which nothing is added to before the scope ends: pointers stay.
    void open(const std::string& name, std::uint32_t kind) {
        close(name);
        OrderedJson& object = kind == PROBE_OBJECT ? add(name, OrderedJson::object()) : member(name, kind == PROBE_SCOPE);
        scopes_.push_back({name, &object, {}});
    }
    /// The last member of a list, a new one where `another` or where there is none.
    OrderedJson& member(const std::string& name, bool another) {
        OrderedJson& list = (*scopes_.back().object)[name];
        if (another || list.empty()) list.push_back(OrderedJson::object());
        return list.back();
    }
    void close(const std::string& name) {
        const auto found = std::ranges::find(scopes_.begin() + 1, scopes_.end(), name, &Scope::name);
        scopes_.erase(found, scopes_.end());
    }
    OrderedJson& add(const std::string& name, OrderedJson value) {
        Scope& scope = scopes_.back();
        if (!scope.object->contains(name)) return (*scope.object)[name] = std::move(value);
        OrderedJson& old = (*scope.object)[name];
        if (scope.repeated.insert(name).second) old = OrderedJson::array({std::move(old)});
        old.push_back(std::move(value));
        return old.back();
    }

    OrderedJson root_;
    std::deque<Scope> scopes_;
};

}  // namespace

OrderedJson numberJson(float value) {
    if (!std::isfinite(value)) return fmt::format("{}", value);
    return std::strtod(fmt::format("{}", value).c_str(), nullptr);
}

OrderedJson probeTree(const ProbedDispatch& dispatch, glm::ivec2 pixel) {
    std::vector<std::uint32_t> order{std::uint32_t(pixel.x) | std::uint32_t(pixel.y) << 16};
    std::map<std::uint32_t, Teller> tellers;
    static const ProbeSite nameless;
    for (const ProbeRecord& record : dispatch.records) {
        const auto [teller, isNew] = tellers.try_emplace(record.invocation, glm::ivec2(record.invocation & 0xffffu, record.invocation >> 16));
        if (isNew && record.invocation != order.front()) order.push_back(record.invocation);
        const auto site = dispatch.sites->find(record.place);
        teller->second.take(record, site == dispatch.sites->end() ? nameless : site->second);
    }
    std::ranges::sort(order.begin() + 1, order.end());  // of several invocations any may come first
    OrderedJson told = OrderedJson::array();
    for (const std::uint32_t invocation : order)
        if (const auto teller = tellers.find(invocation); teller != tellers.end() && teller->second.root().size() > 1)
            told.push_back(std::move(teller->second.root()));
    return told;
}

}  // namespace lodestir
