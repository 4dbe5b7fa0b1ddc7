// SPDX-License-Identifier: MIT
// A command of the program and its options. CLI11 does the work, but takes seconds to compile: only command_line.cpp has to read it.
#pragma once
#include <functional>
#include <initializer_list>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lodestir {

/// One option of a command; a copy means the same option.
class CommandOption {
public:
    explicit CommandOption(CLI::Option* option) : option_(option) {}

    CommandOption& required();
    CommandOption& about(const std::string& text);
    CommandOption& showDefault();                 ///< the value that the variable has now, in the help
    CommandOption& repeatable();                  ///< given several times, with one value each
    CommandOption& list(int count = 0);           ///< values separated by commas, as many as that; 0: one or more
    CommandOption& trimmed();                     ///< spaces around a value don't count
    CommandOption& within(int least, int most);
    CommandOption& oneOf(std::initializer_list<int> values);
    CommandOption& check(std::function<std::string(const std::string& value)> problem);  ///< what is wrong with a value; empty: nothing
    CommandOption& needs(const CommandOption& other);
    CommandOption& excludes(const CommandOption& other);

private:
    CLI::Option* option_;
};

class Command {
public:
    /// Adds the command to the program.
    Command(CLI::App& app, const std::string& name, const std::string& about);

    /// An option, or an argument where the name has no dashes, that sets a variable: a text, a path, a number, or a vector of those
    /// (command_line.cpp says which types there are).
    template <class T> CommandOption option(const std::string& name, T& value, const std::string& about);
    /// One whose value is handed over; the type is to be named.
    template <class T> CommandOption taken(const std::string& name, const std::function<void(const T& value)>& take, const std::string& about);
    CommandOption flag(const std::string& name, bool& value, const std::string& about);
    CommandOption find(const std::string& name);
    void footer(const std::string& text);
    /// When this command is chosen, `run` becomes `work`, which returns the exit status and throws Error.
    void does(std::function<int()>& run, const std::function<int()>& work);

private:
    CLI::App* app_;
};

/// What to say of arguments that no option takes; empty where there are none.
std::string unexpectedArguments(const CLI::App& app);

/// Wrong use that is only found when a command looks closer: CLI::ValidationError.
[[noreturn]] void refuseOption(const std::string& name, const std::string& problem);

}  // namespace lodestir
