// SPDX-License-Identifier: MIT
// Reads JSON (RFC 8259) by recursive descent and notes the line and column of every key and value.
// Columns count Unicode code points, as editors do. Lines end with \n (or \r\n). A byte order mark at the start is skipped.
#include <framework/core/files.h>
#include <framework/core/json.h>

#include <charconv>
#include <locale>
#include <sstream>
#include <unordered_map>
#include <utility>

namespace lodestir {
namespace {

constexpr int nestingLimit = 128;  // the reader recurses: each level costs stack

bool isDigit(int c) { return c >= '0' && c <= '9'; }
bool isLetter(int c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Bytes of the well-formed UTF-8 sequence at the start of `text`, 0 when it isn't one (RFC 3629, section 4).
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
    if (first >= 0xE0 && first <= 0xEF) {
        const bool overlong = first == 0xE0 && second < 0xA0, surrogate = first == 0xED && second > 0x9F;
        return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
    }
    if (first >= 0xF0 && first <= 0xF4) {
        const bool overlong = first == 0xF0 && second < 0x90, beyond = first == 0xF4 && second > 0x8F;
        return follows(1) && follows(2) && follows(3) && !overlong && !beyond ? 4 : 0;
    }
    return 0;
}

void appendUtf8(std::string& text, unsigned code) {
    const auto add = [&](unsigned byte) { text += static_cast<char>(byte); };
    const auto addTail = [&](unsigned shift) { add(0x80u | ((code >> shift) & 0x3Fu)); };
    if (code < 0x80) {
        add(code);
    } else if (code < 0x800) {
        add(0xC0u | (code >> 6));
        addTail(0);
    } else if (code < 0x10000) {
        add(0xE0u | (code >> 12));
        addTail(6);
        addTail(0);
    } else {
        add(0xF0u | (code >> 18));
        addTail(12);
        addTail(6);
        addTail(0);
    }
}

}  // namespace

class JsonReader {
public:
    JsonReader(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
        constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
        if (text_.starts_with(byteOrderMark)) text_.remove_prefix(byteOrderMark.size());
    }

    Json read() {
        skipSpace();
        Json value = readValue("a JSON value");
        skipSpace();
        if (!atEnd()) fail("expected the end of the file after the value, found " + found());
        problems_.raise();
        return value;
    }

private:
    bool atEnd() const { return position_ == text_.size(); }
    int peek() const { return atEnd() ? -1 : static_cast<unsigned char>(text_[position_]); }
    Where here() const { return {file_, line_, column_}; }

    /// Steps over one byte; continuation bytes of a code point take no column of their own.
    void step() {
        const int c = peek();
        ++position_;
        if (c == '\n') {
            ++line_;
            column_ = 1;
        } else if ((c & 0xC0) != 0x80) {
            ++column_;
        }
    }

    bool accept(char c) {
        if (peek() != c) return false;
        step();
        return true;
    }

    void skipSpace() {
        while (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r') step();
    }

    /// What stands here, for messages: a word, a visible character, or the name of something invisible.
    std::string found() const {
        if (atEnd()) return "the end of the file";
        if (peek() == '\n' || peek() == '\r') return "the end of the line";
        std::size_t length = 0;
        while (position_ + length < text_.size() && length < 24 && isLetter(text_[position_ + length])) ++length;
        if (length == 0) length = sequenceLength(text_.substr(position_));
        if (length == 0) return "a byte that is not UTF-8";
        if (peek() < 0x20 || peek() == 0x7F) return "a control character (code " + std::to_string(peek()) + ")";
        return "'" + std::string(text_.substr(position_, length)) + "'";
    }

    [[noreturn]] void fail(Where where, std::string what, std::string hint = {}) {
        problems_.add(std::move(where), std::move(what), std::move(hint));
        throw Error(problems_.list());
    }
    [[noreturn]] void fail(std::string what, std::string hint = {}) {
        fail(here(), std::move(what), hint.empty() ? guess() : std::move(hint));
    }

    /// Other dialects put these where JSON wants something else.
    std::string guess() const {
        const std::string_view rest = text_.substr(position_);
        if (rest.starts_with("//") || rest.starts_with("/*") || rest.starts_with('#')) return "JSON has no comments";
        if (rest.starts_with('\'')) return "JSON strings stand in double quotes";
        for (const std::string_view word : {"True", "False", "None", "undefined"}) {
            if (rest.starts_with(word)) return "JSON knows true, false and null";
        }
        for (const std::string_view word : {"NaN", "nan", "Infinity", "-Infinity", "inf", "-inf"}) {
            if (rest.starts_with(word)) return "JSON numbers are finite";
        }
        return {};
    }

    Json readValue(const char* expected) {
        Json value;
        value.where_ = here();
        const int c = peek();
        if (c == '{') {
            readObject(value);
        } else if (c == '[') {
            readArray(value);
        } else if (c == '"') {
            value.kind_ = Json::Kind::string;
            value.string_ = readString();
        } else if (isDigit(c) || (c == '-' && position_ + 1 < text_.size() && !isLetter(text_[position_ + 1]))) {
            readNumber(value);
        } else if (!readWord(value)) {
            fail(std::string("expected ") + expected + ", found " + found());
        }
        return value;
    }

    /// true, false or null.
    bool readWord(Json& value) {
        std::size_t length = 0;
        while (position_ + length < text_.size() && (isLetter(text_[position_ + length]) || isDigit(text_[position_ + length]))) ++length;
        const std::string_view word = text_.substr(position_, length);
        if (word != "true" && word != "false" && word != "null") return false;
        if (word != "null") {
            value.kind_ = Json::Kind::boolean;
            value.boolean_ = word == "true";
        }
        for (std::size_t i = 0; i < length; ++i) step();
        return true;
    }

    void enter() {
        if (++depth_ > nestingLimit) fail("is nested deeper than " + std::to_string(nestingLimit) + " levels");
    }

    void readArray(Json& array) {
        array.kind_ = Json::Kind::array;
        enter();
        step();
        skipSpace();
        if (!accept(']')) {
            const char* expected = "a value or ']'";
            do {
                skipSpace();
                if (peek() == ']') fail("expected a value after ',', found ']'", "remove the comma before it");
                array.items_.push_back(readValue(expected));
                expected = "a value after ','";
                skipSpace();
            } while (accept(','));
            if (!accept(']')) fail("expected ',' or ']' after an element, found " + found());
        }
        --depth_;
    }

    void readObject(Json& object) {
        object.kind_ = Json::Kind::object;
        enter();
        step();
        skipSpace();
        if (!accept('}')) {
            std::unordered_map<std::string, Where> firsts;
            const char* expected = "a key in double quotes or '}'";
            do {
                skipSpace();
                if (peek() == '}') fail("expected a key after ',', found '}'", "remove the comma before it");
                if (peek() != '"') {
                    fail(std::string("expected ") + expected + ", found " + found(), isLetter(peek()) ? "keys stand in double quotes" : "");
                }
                readMember(object, firsts);
                expected = "a key in double quotes after ','";
                skipSpace();
            } while (accept(','));
            if (!accept('}')) fail("expected ',' or '}' after a member, found " + found());
        }
        --depth_;
    }

    void readMember(Json& object, std::unordered_map<std::string, Where>& firsts) {
        const Where keyWhere = here();
        std::string key = readString();
        skipSpace();
        if (!accept(':')) fail("expected ':' after the key \"" + key + "\", found " + found());
        skipSpace();
        Json value = readValue("a value after ':'");
        value.keyWhere_ = keyWhere;
        const auto [first, isNew] = firsts.emplace(key, keyWhere);
        if (isNew) {
            object.members_.emplace_back(std::move(key), std::move(value));
        } else {
            problems_.add(keyWhere, "the key \"" + key + "\" is given twice",
                          "first given at line " + std::to_string(first->second.line) + ", column " + std::to_string(first->second.column));
        }
    }

    std::string readString() {
        const Where start = here();
        step();
        std::string text;
        while (peek() != '"') {
            if (atEnd() || peek() == '\n') fail(start, "expected '\"' at the end of this string, found " + found());
            if (peek() < 0x20) fail("expected an escape such as \\t or \\u0000, found " + found());
            if (peek() == '\\') {
                readEscape(text);
                continue;
            }
            const std::size_t length = sequenceLength(text_.substr(position_));
            if (length == 0) fail("expected UTF-8 text, found " + found(), "save the file as UTF-8");
            text += text_.substr(position_, length);
            for (std::size_t i = 0; i < length; ++i) step();
        }
        step();
        return text;
    }

    void readEscape(std::string& text) {
        const Where start = here();
        step();
        const int c = peek();
        constexpr std::string_view names = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
        if (const auto i = c < 0 ? names.npos : names.find(static_cast<char>(c)); i != names.npos) {
            step();
            text += meanings[i];
            return;
        }
        if (c != 'u') {
            fail(start, "expected one of \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u after '\\', found " + found(), "a backslash itself is \\\\");
        }
        step();
        unsigned code = readHex();
        if (code >= 0xD800 && code <= 0xDBFF) {  // the first half of a surrogate pair (RFC 8259, section 7)
            const char* const unpaired = "expected the second half of a surrogate pair (\\uDC00 to \\uDFFF) after this \\u escape";
            if (!accept('\\') || !accept('u')) fail(start, unpaired);
            const unsigned low = readHex();
            if (low < 0xDC00 || low > 0xDFFF) fail(start, unpaired);
            code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
        } else if (code >= 0xDC00 && code <= 0xDFFF) {
            fail(start, "expected the first half of a surrogate pair (\\uD800 to \\uDBFF) before this \\u escape");
        }
        appendUtf8(text, code);
    }

    unsigned readHex() {
        unsigned code = 0;
        for (int i = 0; i < 4; ++i) {
            const int c = peek();
            const int digit = isDigit(c) ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
            if (digit < 0) fail("expected four hexadecimal digits after \\u, found " + found());
            code = code * 16 + static_cast<unsigned>(digit);
            step();
        }
        return code;
    }

    void readDigits(const char* where) {
        if (!isDigit(peek())) fail(std::string("expected a digit ") + where + ", found " + found());
        while (isDigit(peek())) step();
    }

    void readNumber(Json& value) {
        const std::size_t begin = position_;
        bool integer = true;
        accept('-');
        if (accept('0')) {
            if (isDigit(peek())) {
                fail(value.where_, "expected no digits after a leading 0", "JSON numbers are decimal, without leading zeros");
            }
        } else {
            readDigits("after '-'");
        }
        if (accept('.')) {
            integer = false;
            readDigits("after '.'");
        }
        if (accept('e') || accept('E')) {
            integer = false;
            if (!accept('+')) accept('-');
            readDigits("in the exponent");
        }
        const std::string_view digits = text_.substr(begin, position_ - begin);
        value.kind_ = integer ? Json::Kind::integer : Json::Kind::number;
        if (integer) {
            if (std::from_chars(digits.data(), digits.data() + digits.size(), value.integer_).ec != std::errc{}) {
                problems_.add(value.where_, "expected an integer of 64 bits, found " + std::string(digits.substr(0, 40)),
                              "with a decimal point it is read as a floating-point number");
            }
            return;
        }
        if (std::from_chars(digits.data(), digits.data() + digits.size(), value.number_).ec == std::errc{}) return;
        // Out of range: from_chars doesn't say whether the number is too large, which is wrong, or so small that it is 0, which is right.
        std::istringstream stream{std::string(digits)};
        stream.imbue(std::locale::classic());
        if (!(stream >> value.number_)) {
            problems_.add(value.where_, "expected a number that a 64-bit float can hold, found " + std::string(digits.substr(0, 40)),
                          "the largest is about 1.8e308");
        }
    }

    std::string_view text_;
    std::string file_;
    std::size_t position_ = 0;
    int line_ = 1, column_ = 1;
    int depth_ = 0;
    Problems problems_;
};

Json Json::parse(std::string_view text, const std::string& file) { return JsonReader(text, file).read(); }

Json Json::load(const std::filesystem::path& path) { return parse(readText(path), path.string()); }

}  // namespace lodestir
