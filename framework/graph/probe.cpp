// SPDX-License-Identifier: MIT
#include <framework/graph/probe.h>

#include <framework/core/error.h>
#include <framework/gpu/include_closure.h>

#include <algorithm>
#include <cctype>

namespace lodestir {
namespace {

bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

std::string_view codeOf(std::string_view line) { return line.substr(0, line.find("//")); }

}  // namespace

std::vector<ProbeSite> probeSitesOf(std::string_view line) {
    line = codeOf(line);
    if (const std::size_t first = line.find_first_not_of(" \t"); first != line.npos && line[first] == '#') return {};
    std::vector<ProbeSite> sites;
    constexpr std::string_view prefix = "PROBE";
    for (std::size_t at = line.find(prefix); at != line.npos; at = line.find(prefix, at + 1)) {
        if (at > 0 && isWordCharacter(line[at - 1])) continue;
        const auto end = std::find_if_not(line.begin() + std::ptrdiff_t(at), line.end(), isWordCharacter);
        if (end == line.end() || *end != '(') continue;
        const auto name = std::find_if(end, line.end(), isWordCharacter), nameEnd = std::find_if_not(name, line.end(), isWordCharacter);
        ProbeSite site{std::string(name, nameEnd), {}};
        if (const auto quote = std::find(end, line.end(), '"'); quote != line.end()) site.words = std::string(quote + 1, std::find(quote + 1, line.end(), '"'));
        sites.push_back(std::move(site));
    }
    return sites;
}

ProbeSites probeSites(const gpu::IncludeClosure& closure) {
    ProbeSites sites;
    for (std::size_t index = 0; index < closure.texts().size(); ++index) {
        const gpu::ShaderText& text = closure.texts()[index];
        std::uint32_t number = 1;
        for (std::size_t begin = 0; begin < text.text.size(); ++number) {
            const std::size_t end = std::min(text.text.find('\n', begin), text.text.size());
            std::vector<ProbeSite> found = probeSitesOf(std::string_view(text.text).substr(begin, end - begin));
            if (found.size() > 1)
                throw Error({text.name, int(number), 0}, "two PROBE macros stand in one line, which can't be told apart", "give each a line of its own");
            if (!found.empty()) sites[std::uint32_t(index) << 16 | number] = std::move(found.front());
            begin = end + 1;
        }
    }
    return sites;
}

}  // namespace lodestir
