// SPDX-License-Identifier: MIT
// A shader file together with everything that it may include, found by a scan of the #include lines alone.
#include <framework/core/is_file.h>
#include <framework/gpu/include_closure.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace lodestir::gpu {

namespace {

struct FoundInclude {
    Include include;
    bool local = true;  ///< "name" rather than <name>
};

std::string_view withoutBlanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

// Reads `# include "name"` or `# include <name>`; an empty name when the line is something else.
std::pair<std::string, bool> parseInclude(std::string_view line) {
    line = withoutBlanks(line);
    if (!line.starts_with('#')) return {};
    line = withoutBlanks(line.substr(1));
    if (!line.starts_with("include")) return {};
    line = withoutBlanks(line.substr(7));
    if (line.empty() || (line[0] != '"' && line[0] != '<')) return {};
    const std::size_t end = line.find(line[0] == '"' ? '"' : '>', 1);
    if (end == std::string_view::npos) return {};
    return {std::string(line.substr(1, end - 1)), line[0] == '"'};
}

// Follows block comments over a line's end; returns whether the next line starts inside one.
bool endsInComment(std::string_view line, bool inComment) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (inComment) {
            if (line[i] == '*' && line[i + 1] == '/') inComment = false, ++i;
        } else if (line[i] == '/' && line[i + 1] == '/') {
            return false;
        } else if (line[i] == '/' && line[i + 1] == '*') {
            inComment = true, ++i;
        }
    }
    return inComment;
}

std::vector<FoundInclude> scan(std::string_view text) {
    std::vector<FoundInclude> found;
    bool inComment = false;
    int number = 1;
    for (std::size_t begin = 0; begin < text.size(); ++number) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        if (!inComment)
            if (auto [name, local] = parseInclude(line); !name.empty()) found.push_back({{number, begin, end, std::move(name), -1}, local});
        inComment = endsInComment(line, inComment);
        begin = end + 1;
    }
    return found;
}

}  // namespace

IncludeClosure::IncludeClosure(const Path& entry, const std::vector<Path>& folders, const std::map<std::string, std::string>& generated)
    : folders_(&folders), generated_(&generated) {
    known_[std::filesystem::weakly_canonical(entry).string()] = add(entry.string(), entry, readText(entry));
    for (std::size_t i = 0; i < texts_.size(); ++i) {  // grows as files are found
        const Path from = texts_[i].path.parent_path();
        for (FoundInclude& found : scan(texts_[i].text)) {
            const bool local = found.local && !texts_[i].path.empty();
            found.include.target = find(found.include, local, from);
            texts_[i].includes.push_back(std::move(found.include));
        }
    }
}

int IncludeClosure::add(std::string name, Path path, std::string text) {
    texts_.push_back({std::move(name), std::move(path), std::move(text), {}});
    return static_cast<int>(texts_.size()) - 1;
}

int IncludeClosure::find(const Include& include, bool local, const Path& from) {
    std::vector<Path> candidates;
    if (local) candidates.push_back(from / include.name);
    for (const Path& folder : *folders_) candidates.push_back(folder / include.name);
    for (const Path& candidate : candidates) {
        if (!isFile(candidate)) continue;
        const auto [known, isNew] = known_.try_emplace(std::filesystem::weakly_canonical(candidate).string(), 0);
        if (isNew) {
            const Path path = candidate.lexically_normal();
            known->second = add(path.string(), path, readText(path));
        }
        return known->second;
    }
    const auto text = generated_->find(include.name);
    if (text == generated_->end()) return -1;
    const auto [known, isNew] = known_.try_emplace("<" + include.name + ">", 0);
    if (isNew) known->second = add(include.name, {}, text->second);
    return known->second;
}

std::vector<Path> IncludeClosure::files() const {
    std::vector<Path> files;
    for (const ShaderText& text : texts_)
        if (!text.path.empty()) files.push_back(text.path);
    return files;
}

void IncludeClosure::addTo(Hash& hash) const {
    hash.addValue(texts_.size());
    for (const ShaderText& text : texts_) {
        hash.addValue(text.text.size()).add(text.text);
        for (const Include& include : text.includes) hash.addValue(include.target);
    }
}

}  // namespace lodestir::gpu
