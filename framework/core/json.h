// SPDX-License-Identifier: MIT
// JSON values that know the place they were written at, so that every complaint can point to it.
#pragma once
#include <framework/core/api.h>
#include <framework/core/error.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lodestir {

class LODESTIR_API Json {
public:
    enum class Kind { null, boolean, integer, number, string, array, object };
    using Member = std::pair<std::string, Json>;

    Json() = default;
    Json(bool value);
    Json(int value);
    Json(std::int64_t value);
    Json(double value);
    Json(std::string value);
    Json(const char* value);
    static Json array();
    static Json object();

    /// Parses RFC 8259 JSON. Throws Error at the place of a syntax error, of a key given twice, of a number that doesn't fit its type, or
    /// of nesting deeper than 128. Columns count code points, as editors do.
    static Json parse(std::string_view text, const std::string& file);
    /// Reads and parses a file; Error when it cannot be read.
    static Json load(const std::filesystem::path& path);
    /// Converts from a plain nlohmann value (no places).
    static Json from(const nlohmann::ordered_json& value);
    /// Converts to a plain nlohmann value, members in order.
    nlohmann::ordered_json plain() const;
    /// Text; indent < 0 gives one line. Numbers that are not finite, which JSON hasn't, are written as null.
    std::string dump(int indent = 2) const;

    Kind kind() const { return kind_; }
    const Where& where() const { return where_; }     ///< place of the value
    const Where& keyWhere() const { return keyWhere_; }  ///< place of its key, where it is a member
    bool isNull() const { return kind_ == Kind::null; }
    bool isNumber() const { return kind_ == Kind::integer || kind_ == Kind::number; }
    bool isString() const { return kind_ == Kind::string; }
    bool isObject() const { return kind_ == Kind::object; }
    bool isArray() const { return kind_ == Kind::array; }
    const char* kindName() const;
    /// Gives the value, and all that is in it, this place: for values that come from no file.
    void moveTo(const Where& where);

    /// Values, checked: each throws Error at where() naming what was expected and what is there. `what` names the value in the message.
    bool asBool(std::string_view what = "value") const;
    std::int64_t asInt(std::string_view what = "value") const;    ///< accepts 3 and 3.0
    double asNumber(std::string_view what = "value") const;
    const std::string& asString(std::string_view what = "value") const;
    const std::vector<Json>& items(std::string_view what = "value") const;     ///< of an array
    const std::vector<Member>& members(std::string_view what = "value") const;  ///< of an object, in order

    const Json* find(std::string_view key) const;  ///< member or nullptr (also when not an object)
    /// Member; adds it (null) when missing, turning a null into an object.
    Json& operator[](std::string_view key);
    void push(Json value);
    bool remove(std::string_view key);

    /// RFC 7396 merge patch: members of `patch` replace, null removes, objects merge. Values keep the places they come from.
    void merge(const Json& patch);
    /// Reports every member whose key is not in `known`, with a hint, into `problems`.
    void expectOnly(std::span<const std::string> known, std::string_view what, Problems& problems) const;

private:
    Kind kind_ = Kind::null;
    Where where_, keyWhere_;
    bool boolean_ = false;
    std::int64_t integer_ = 0;
    double number_ = 0;
    std::string string_;
    std::vector<Json> items_;
    std::vector<Member> members_;
    friend class JsonReader;
};

}  // namespace lodestir
