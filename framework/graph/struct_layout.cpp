// SPDX-License-Identifier: MIT
// A small reader of struct declarations: tokens, conditions on __cplusplus (the shader's side is taken), integer constants.
#include <framework/graph/struct_layout.h>

#include <framework/core/error.h>
#include <framework/gpu/include_closure.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

namespace lodestir {
namespace {

struct Token {
    std::string text;
    Where where;
};

struct Layout {
    std::size_t size = 0, alignment = 1;
};

std::size_t roundUp(std::size_t value, std::size_t step) { return (value + step - 1) / step * step; }

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// "8", "8u", "0x10u"; empty when it is something else.
std::optional<std::size_t> integer(std::string_view text) {
    if (text.ends_with('u') || text.ends_with('U')) text.remove_suffix(1);
    const bool hex = text.starts_with("0x") || text.starts_with("0X");
    if (hex) text.remove_prefix(2);
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, hex ? 16 : 10);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// The text with comments blanked out; line breaks stay.
std::string withoutComments(std::string text) {
    const auto blank = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (text[i] != '\n') text[i] = ' ';
    };
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] != '/' || (text[i + 1] != '/' && text[i + 1] != '*')) continue;
        const bool line = text[i + 1] == '/';
        const std::size_t found = text.find(line ? "\n" : "*/", i + 2);
        const std::size_t end = found == text.npos ? text.size() : found + (line ? 0 : 2);
        blank(i, end);
        i = end - 1;
    }
    return text;
}

/// The tokens of headers and the integer constants among them.
class Declarations {
public:
    void read(const std::string& file, const std::string& text);

    std::vector<Token> tokens;
    std::map<std::string, std::size_t> constants;

private:
    void readDirective(std::string_view line);
    bool skipping() const { return std::ranges::find(skipped_, true) != skipped_.end(); }

    std::vector<bool> skipped_;      ///< of each condition we are in: is this side C++'s
    std::vector<bool> conditional_;  ///< of each condition we are in: is it about __cplusplus
};

void Declarations::read(const std::string& file, const std::string& text) {
    const std::string code = withoutComments(text);
    skipped_.clear();
    conditional_.clear();
    int line = 1;
    bool lineStart = true;
    for (std::size_t i = 0; i < code.size();) {
        if (code[i] == '\n') {
            ++line, ++i;
            lineStart = true;
        } else if (std::isspace(static_cast<unsigned char>(code[i]))) {
            ++i;
        } else if (lineStart && code[i] == '#') {
            std::size_t end = std::min(code.find('\n', i), code.size());
            const std::size_t first = end;
            while (end < code.size() && code[end - 1] == '\\') {  // goes on in the next line
                ++line;
                end = std::min(code.find('\n', end + 1), code.size());
            }
            readDirective(std::string_view(code).substr(i + 1, first - i - 1));
            i = end;
        } else {
            std::size_t end = i + 1;
            if (isWord(code[i]))
                while (end < code.size() && isWord(code[end])) ++end;
            if (!skipping()) tokens.push_back({code.substr(i, end - i), {file, line}});
            lineStart = false;
            i = end;
        }
    }
    // `const uint NAME = 8u;`
    for (std::size_t i = 0; i + 4 < tokens.size(); ++i) {
        if (tokens[i].text != "const" || tokens[i + 3].text != "=") continue;
        if (const auto value = integer(tokens[i + 4].text)) constants.emplace(tokens[i + 2].text, *value);
    }
}

void Declarations::readDirective(std::string_view line) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < line.size();) {
        std::size_t end = i;
        while (end < line.size() && isWord(line[end])) ++end;
        if (end > i) words.emplace_back(line.substr(i, end - i));
        i = std::max(end, i + 1);
    }
    if (words.empty()) return;
    const bool cpp = std::ranges::find(words, "__cplusplus") != words.end();
    if (words[0] == "ifdef" || words[0] == "ifndef" || words[0] == "if") {
        conditional_.push_back(cpp);
        skipped_.push_back(cpp && words[0] != "ifndef" && line.find('!') == line.npos);
    } else if ((words[0] == "else" || words[0] == "elif") && !skipped_.empty()) {
        if (conditional_.back()) skipped_.back() = !skipped_.back();
    } else if (words[0] == "endif" && !skipped_.empty()) {
        skipped_.pop_back();
        conditional_.pop_back();
    } else if (words[0] == "define" && words.size() == 3 && !skipping()) {
        if (const auto value = integer(words[2])) constants.emplace(words[1], *value);
    }
}

/// Reads struct bodies, one inside the other.
class StructReader {
public:
    StructReader(const Declarations& declarations, const std::string& header) : d_(declarations), header_(header) {}

    Layout read(const std::string& name, const Where& user, std::vector<StructField>& fields) {
        if (std::ranges::find(open_, name) != open_.end()) throw Error(user, "struct \"" + name + "\" holds itself");
        open_.push_back(name);
        at_ = bodyOf(name, user);
        Layout all;
        while (text() != "}") readMembers(all, fields);
        open_.pop_back();
        all.size = roundUp(all.size, all.alignment);
        return all;
    }

private:
    /// Index of the first token of the body.
    std::size_t bodyOf(const std::string& name, const Where& user) const {
        std::vector<std::string> known;
        for (std::size_t i = 0; i + 2 < d_.tokens.size(); ++i) {
            if (d_.tokens[i].text != "struct" || d_.tokens[i + 2].text != "{") continue;
            if (d_.tokens[i + 1].text == name) return i + 3;
            known.push_back(d_.tokens[i + 1].text);
        }
        throw Error(user,
                    open_.size() < 2 ? "there is no struct \"" + name + "\" in " + header_ + " and what it includes"
                                     : "unknown type \"" + name + "\"",
                    didYouMean(name, known));
    }

    const std::string& text() const {
        if (at_ >= d_.tokens.size()) throw Error(Where{header_}, "struct \"" + open_.back() + "\" does not end");
        return d_.tokens[at_].text;
    }
    const Where& where() const { return d_.tokens[at_].where; }
    std::string next() {
        std::string result = text();
        ++at_;
        return result;
    }
    void expect(const char* what) {
        if (text() != what) throw Error(where(), "expected " + std::string(what) + " in struct \"" + open_.back() + "\", found " + text());
        ++at_;
    }

    /// `type name, name[2], ...;`
    void readMembers(Layout& all, std::vector<StructField>& fields) {
        const Where typeWhere = where();
        StructField kind;
        Layout one = readType(kind, typeWhere);
        do {
            StructField field = kind;
            if (!isWord(text()[0])) throw Error(where(), "expected a name in struct \"" + open_.back() + "\", found " + text());
            field.name = next();
            if (text() == "[") {
                ++at_;
                field.count = readLength();
                expect("]");
            }
            field.size = one.size;
            field.offset = roundUp(all.size, one.alignment);
            all.size = field.offset + one.size * std::max<std::size_t>(field.count, 1);
            all.alignment = std::max(all.alignment, one.alignment);
            fields.push_back(std::move(field));
        } while (text() == "," && ++at_);
        expect(";");
    }

    Layout readType(StructField& kind, const Where& user) {
        kind.type = next();
        if (kind.type.starts_with("LODESTIR_") && text() == "(") {  // a macro for an address, typed in shaders, a number in C++
            while (next() != ")") {}
            kind.type = "uint64_t";
        }
        if (const NumberType number = numberType(kind.type); number.kind)
            return {number.bytes * number.rows * number.columns, number.bytes};
        const std::size_t resume = at_;
        const Layout layout = read(kind.type, user, kind.members);
        at_ = resume;
        return layout;
    }

    std::size_t readLength() {
        const Where place = where();
        const std::string word = next();
        if (const auto number = integer(word); number && *number > 0) return *number;
        if (const auto constant = d_.constants.find(word); constant != d_.constants.end() && constant->second > 0) return constant->second;
        throw Error(place, "the length of an array is \"" + word + "\", which is neither a number nor a constant of the headers");
    }

    const Declarations& d_;
    const std::string& header_;
    std::size_t at_ = 0;
    std::vector<std::string> open_;  ///< the structs being read, outermost first
};

Path findHeader(const Path& header, const std::vector<Path>& folders) {
    std::error_code none;
    if (std::filesystem::is_regular_file(header, none)) return header;
    for (const Path& folder : folders)
        if (std::filesystem::is_regular_file(folder / header, none)) return folder / header;
    throw Error(Where{header.string()}, "there is no such header");
}

}  // namespace

NumberType numberType(std::string_view name) {
    if (name == "float") return {'f', 4};
    if (name == "double") return {'f', 8};
    if (name == "int") return {'i', 4};
    if (name == "uint") return {'u', 4};
    if (name == "uint64_t") return {'u', 8};
    if (name == "int64_t") return {'i', 8};
    if (name == "uint16_t") return {'u', 2};
    if (name == "uint8_t") return {'u', 1};
    const bool digit = !name.empty() && name.back() >= '2' && name.back() <= '4';
    const std::size_t n = digit ? static_cast<std::size_t>(name.back() - '0') : 0;
    const std::string_view stem = digit ? name.substr(0, name.size() - 1) : name;
    if (digit && stem == "vec") return {'f', 4, 1, n};
    if (digit && stem == "ivec") return {'i', 4, 1, n};
    if (digit && stem == "uvec") return {'u', 4, 1, n};
    if (digit && stem == "mat") return {'f', 4, n, n};
    return {};
}

std::vector<StructField> structFields(std::string_view name, const Path& header, const std::vector<Path>& folders,
                                      std::size_t expectedSize) {
    std::vector<StructField> fields;
    Layout layout;
    if (header.empty()) {
        const NumberType number = numberType(name);
        if (!number.kind) throw Error("\"" + std::string(name) + "\" is no built-in type");
        layout.size = number.bytes * number.rows * number.columns;
        fields.push_back({.name = {}, .type = std::string(name), .size = layout.size, .members = {}});
    } else {
        const std::map<std::string, std::string> generated;
        const gpu::IncludeClosure closure(findHeader(header, folders), folders, generated);
        Declarations declarations;
        for (const gpu::ShaderText& text : closure.texts()) declarations.read(text.name, text.text);
        const std::string entry = closure.texts().front().name;
        layout = StructReader(declarations, entry).read(std::string(name), Where{entry}, fields);
    }
    if (layout.size != expectedSize)
        throw Error(Where{header.string()},
                    "the fields of \"" + std::string(name) + "\" take " + std::to_string(layout.size) + " bytes, the program has " +
                        std::to_string(expectedSize),
                    "rebuild: the header may have changed since");
    return fields;
}

}  // namespace lodestir
