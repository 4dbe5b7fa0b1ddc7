// SPDX-License-Identifier: MIT
#include <framework/app/command_line.h>

#include <framework/core/error.h>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lodestir {

CommandOption& CommandOption::required() {
    option_->required();
    return *this;
}

CommandOption& CommandOption::about(const std::string& text) {
    option_->description(text);
    return *this;
}

CommandOption& CommandOption::showDefault() {
    option_->capture_default_str();
    return *this;
}

CommandOption& CommandOption::repeatable() {
    option_->take_all()->allow_extra_args(false);
    return *this;
}

CommandOption& CommandOption::list(int count) {
    option_->delimiter(',');
    if (count > 0) option_->expected(count);
    option_->allow_extra_args(false);  // what follows may be a file
    return *this;
}

CommandOption& CommandOption::trimmed() {
    option_->transform([](const std::string& text) { return CLI::detail::trim_copy(text); });
    return *this;
}

CommandOption& CommandOption::within(int least, int most) {
    option_->check(CLI::Range(least, most));
    return *this;
}

CommandOption& CommandOption::oneOf(std::initializer_list<int> values) {
    option_->check(CLI::IsMember(values));
    return *this;
}

CommandOption& CommandOption::check(std::function<std::string(const std::string&)> problem) {
    option_->check(std::move(problem));
    return *this;
}

CommandOption& CommandOption::needs(const CommandOption& other) {
    option_->needs(other.option_);
    return *this;
}

CommandOption& CommandOption::excludes(const CommandOption& other) {
    option_->excludes(other.option_);
    return *this;
}

Command::Command(CLI::App& app, const std::string& name, const std::string& about) : app_(app.add_subcommand(name, about)) {}

template <class T> CommandOption Command::option(const std::string& name, T& value, const std::string& about) {
    return CommandOption(app_->add_option(name, value, about));
}
template CommandOption Command::option(const std::string&, std::string&, const std::string&);
template CommandOption Command::option(const std::string&, std::filesystem::path&, const std::string&);
template CommandOption Command::option(const std::string&, int&, const std::string&);
template CommandOption Command::option(const std::string&, double&, const std::string&);
template CommandOption Command::option(const std::string&, std::vector<std::string>&, const std::string&);
template CommandOption Command::option(const std::string&, std::vector<std::filesystem::path>&, const std::string&);
template CommandOption Command::option(const std::string&, std::vector<double>&, const std::string&);

template <class T> CommandOption Command::taken(const std::string& name, const std::function<void(const T&)>& take, const std::string& about) {
    return CommandOption(app_->add_option_function<T>(name, take, about));
}
template CommandOption Command::taken(const std::string&, const std::function<void(const std::string&)>&, const std::string&);
template CommandOption Command::taken(const std::string&, const std::function<void(const int&)>&, const std::string&);
template CommandOption Command::taken(const std::string&, const std::function<void(const std::uint32_t&)>&, const std::string&);
template CommandOption Command::taken(const std::string&, const std::function<void(const std::vector<std::string>&)>&, const std::string&);

CommandOption Command::flag(const std::string& name, bool& value, const std::string& about) {
    return CommandOption(app_->add_flag(name, value, about));
}

CommandOption Command::find(const std::string& name) { return CommandOption(app_->get_option(name)); }

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::does(std::function<int()>& run, const std::function<int()>& work) {
    app_->callback([&run, work] { run = work; });
}

std::string unexpectedArguments(const CLI::App& app) {
    const std::vector<CLI::App*> commands = app.get_subcommands();
    const CLI::App& chosen = commands.empty() ? app : *commands.front();
    const std::vector<std::string> extra = chosen.remaining();
    if (extra.empty()) return {};
    const std::string who = &chosen == &app ? "lodestir" : "lodestir " + chosen.get_name();
    if (extra.front().size() < 2 || extra.front().front() != '-') return who + ": \"" + extra.front() + "\" is one argument too many";
    std::vector<std::string> known;
    for (const CLI::Option* option : chosen.get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    const std::string name = extra.front().substr(0, extra.front().find('='));
    return who + ": no option \"" + name + "\"; " + didYouMean(name, known);
}

void refuseOption(const std::string& name, const std::string& problem) { throw CLI::ValidationError(name, problem); }

}  // namespace lodestir
