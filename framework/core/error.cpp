// SPDX-License-Identifier: MIT
// Texts of problems, gathering them, and guessing what a misspelt name was meant to be.
#include <framework/core/error.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace lodestir {
namespace {

std::string place(const Where& where) {
    std::string text = where.file;
    for (const int number : {where.line, where.column}) {
        if (number == 0) break;  // a column without a line says nothing
        if (!text.empty()) text += ':';
        text += std::to_string(number);
    }
    return text;
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return lower;
}

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (optimal string alignment distance).
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before.swap(last);
        last.swap(row);
    }
    return last[b.size()];
}

/// How far `candidate` is from what was written; a beginning of it counts as near, so that "vertex" finds "vertexMapping".
std::size_t distance(std::string_view name, std::string_view candidate) {
    const std::string a = lowerCase(name), b = lowerCase(candidate);
    if (a.size() >= 3 && b.starts_with(a)) return 1;
    return editDistance(a, b);
}

}  // namespace

std::string Problem::text() const {
    std::string text = place(where);
    if (!text.empty() && !what.empty()) text += ": ";
    text += what;
    if (!text.empty() && !hint.empty()) text += "; ";
    return text + hint;
}

Error::Error(std::vector<Problem> problems) : problems_(std::move(problems)) {
    std::ranges::stable_sort(problems_, {}, [](const Problem& p) { return std::tie(p.where.file, p.where.line, p.where.column); });
    for (const Problem& problem : problems_) {
        if (!text_.empty()) text_ += '\n';
        text_ += problem.text();
    }
}

Error::Error(Where where, std::string what, std::string hint)
    : Error(std::vector<Problem>{{std::move(where), std::move(what), std::move(hint)}}) {}

Error::Error(std::string what, std::string hint) : Error(Where{}, std::move(what), std::move(hint)) {}

Error::~Error() = default;

void Problems::add(Where where, std::string what, std::string hint) {
    problems_.push_back({std::move(where), std::move(what), std::move(hint)});
}

void Problems::add(const Error& error) { problems_.insert(problems_.end(), error.problems().begin(), error.problems().end()); }

void Problems::raise() const {
    if (!problems_.empty()) throw Error(problems_);
}

std::string didYouMean(std::string_view name, std::span<const std::string> candidates) {
    std::size_t best = std::numeric_limits<std::size_t>::max();
    const std::string* nearest = nullptr;
    for (const std::string& candidate : candidates) {
        const std::size_t d = distance(name, candidate);
        if (d < best) {
            best = d;
            nearest = &candidate;
        }
    }
    // One slip in three letters: with more, "radius" would be offered for "albedo".
    if (nearest && best <= std::max<std::size_t>(1, name.size() / 3) && best < name.size()) return "did you mean \"" + *nearest + "\"?";

    constexpr std::size_t listed = 8;  // what still fits on a line
    std::string text;
    for (std::size_t i = 0; i < std::min(listed, candidates.size()); ++i) text += (i == 0 ? "known: " : ", ") + candidates[i];
    if (candidates.size() > listed) text += ", and " + std::to_string(candidates.size() - listed) + " more";
    return text;
}

}  // namespace lodestir
