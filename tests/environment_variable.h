// SPDX-License-Identifier: MIT
// Environment variables, for a while.
#pragma once
#include <cstdlib>
#include <string>

namespace lodestir::test {

/// Sets an environment variable until the end of the scope.
class EnvironmentVariable {
public:
    EnvironmentVariable(const char* name, const char* value)
        : name_(name), old_(std::getenv(name) ? std::getenv(name) : ""), had_(std::getenv(name)) {
        value ? ::setenv(name, value, 1) : ::unsetenv(name);
    }
    ~EnvironmentVariable() { had_ ? ::setenv(name_, old_.c_str(), 1) : ::unsetenv(name_); }
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

private:
    const char* name_;
    std::string old_;
    bool had_;
};

}  // namespace lodestir::test
