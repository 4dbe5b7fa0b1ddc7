// SPDX-License-Identifier: MIT
// Reads the members of a JSON object into typed values; what is wrong is gathered, and the value keeps its default.
#pragma once
#include <framework/core/json.h>

#include <glm/glm.hpp>

#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace lodestir {

class Fields {
public:
    /// `what` names the object in messages. When `value` isn't an object that is a problem, and there are no members.
    Fields(const Json& value, std::string what, Problems& problems);

    /// Reports members that were never asked for, with a hint; call it last.
    void finish();
    /// More keys that are known here though nobody asks for them.
    void allow(std::initializer_list<const char*> keys);

    const Json* find(const char* key);     ///< nullptr when absent
    const Json* require(const char* key);  ///< absent: a problem and nullptr

    void number(const char* key, float& value, double least = -std::numeric_limits<double>::infinity(),
                double most = std::numeric_limits<double>::infinity());
    void integer(const char* key, int& value, int least, int most);
    void text(const char* key, std::string& value);
    void vector(const char* key, glm::vec3& value);
    void color(const char* key, glm::vec3& value);  ///< three numbers >= 0
    /// Index of the name that is given; `value` stays when the key is absent.
    void choice(const char* key, std::size_t& value, const std::vector<std::string>& names);

    const Where& where() const { return value_.where(); }
    void problem(const Where& where, const std::string& what, const std::string& hint = {}) { problems_.add(where, what, hint); }
    Problems& problems() { return problems_; }
    const std::string& what() const { return what_; }

private:
    const Json& value_;
    std::string what_;
    Problems& problems_;
    std::vector<std::string> known_;
};

/// `count` numbers of an array. Error at the value.
std::vector<double> numbersOf(const Json& value, const std::string& what, std::size_t count);

}  // namespace lodestir
