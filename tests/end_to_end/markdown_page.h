// SPDX-License-Identifier: MIT
// A page of the docs that is followed to the letter: its files are written, its commands run, what it promises is looked for.
//
//   a block below a line that is `path`:        is that file
//   a block of sh                               is run, command by command, all of a page in one shell, that starts in a folder given
//   a block of sh below a line that ends in "by hand:"   is left to the reader, and counted
//   a block of text                             is what the commands above it print: its words are looked for, numbers and "..." aren't
//
// A block that is none of these is a fault of the page, as is a command that fails.
#pragma once
#include "process.h"
#include "source_folder.h"

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace lodestir::test {

struct PageBlock {
    int line;              ///< of its first line in the page
    std::string language;  ///< behind the three backticks
    std::string lead;      ///< the last line of text above it
    std::vector<std::string> lines;

    /// The file that the block is; empty where it is none.
    std::string file() const {
        std::smatch name;
        return std::regex_match(lead, name, std::regex("`([^`]+)`:")) ? name[1].str() : std::string();
    }
    bool isByHand() const { return lead.ends_with("by hand:"); }
};

struct PageCommand {
    int line;
    std::string text;
};

inline std::vector<PageBlock> blocksOf(const std::string& page) {
    std::vector<PageBlock> blocks;
    std::istringstream text(page);
    std::string lead;
    bool inside = false;
    int number = 0;
    for (std::string line; std::getline(text, line);) {
        ++number;
        if (line.starts_with("```")) {
            inside = !inside;
            if (inside) blocks.push_back({number + 1, line.substr(3), lead, {}});
            lead.clear();
        } else if (inside)
            blocks.back().lines.push_back(line);
        else if (!line.empty())
            lead = line;
    }
    return blocks;
}

/// Lines that end in a backslash go on in the next one.
inline std::vector<PageCommand> commandsOf(const PageBlock& block) {
    std::vector<PageCommand> commands;
    bool goesOn = false;
    for (std::size_t i = 0; i < block.lines.size(); ++i) {
        const std::string& line = block.lines[i];
        if (goesOn)
            commands.back().text += "\n" + line;
        else if (!line.empty() && line.front() != '#')
            commands.push_back({block.line + int(i), line});
        goesOn = line.ends_with("\\");
    }
    return commands;
}

struct Followed {
    std::vector<std::string> problems;  ///< "page:line: what"; none where all went well
    int files = 0, commands = 0, byHand = 0;
    int leftOut = 0;  ///< commands with a window, where there is no xvfb-run
};

/// Follows a page, `name` in what is said of it. Its shell starts in `start`; `mktemp` makes folders in `folder`, where outputs are kept, too.
inline Followed followPage(const std::string& page, const std::string& name, const Path& start, const Path& folder,
                           std::chrono::duration<double> patience = std::chrono::seconds(600)) {
    Followed result;
    const auto say = [&](int line, const std::string& what) { result.problems.push_back(name + ":" + std::to_string(line) + ": " + what); };
    const auto outputOf = [&](int line) { return folder / ("output." + std::to_string(line)); };

    std::string script = "cd '" + start.string() + "'\n";
    std::vector<PageCommand> commands;
    struct Promise {
        int line;
        std::string text;
        std::vector<int> commands;  ///< that print it: their lines
    };
    std::vector<Promise> promises;
    std::vector<int> above;  // commands of the block above
    const bool hasDisplays = runProcess({"bash", "-c", "command -v xvfb-run"}).exitCode == 0;
    for (const PageBlock& block : blocksOf(page)) {
        if (const std::string file = block.file(); !file.empty()) {
            ++result.files;
            const std::string end = "END_OF_FILE_" + std::to_string(block.line);
            script += "mkdir -p \"$(dirname '" + file + "')\"\ncat > '" + file + "' << '" + end + "'\n";
            for (const std::string& line : block.lines) script += line + "\n";
            script += end + "\n";
        } else if (block.language == "sh" && block.isByHand()) {
            result.byHand += int(commandsOf(block).size());
        } else if (block.language == "sh") {
            above.clear();
            for (const PageCommand& command : commandsOf(block)) {
                if (!hasDisplays && command.text.starts_with("xvfb-run ")) {
                    ++result.leftOut;
                    continue;
                }
                above.push_back(command.line);
                commands.push_back(command);
                std::filesystem::remove(outputOf(command.line));  // of another page
                // In this shell, so that what is exported and where one goes stays.
                script += "at=" + std::to_string(command.line) + "\n{ " + command.text + "\n} > '" + outputOf(command.line).string() +
                          "' 2>&1 < /dev/null || { echo \"$at $?\"; exit 1; }\n";
            }
        } else if (block.language == "text" && !above.empty()) {
            for (std::size_t i = 0; i < block.lines.size(); ++i) promises.push_back({block.line + int(i), block.lines[i], above});
        } else
            say(block.line - 1, "a block that is neither a file, nor commands, nor what they print");
    }

    const Output shell = runProcess({"bash", "-c", script}, {{"TMPDIR", folder.string()}, {"LODESTIR_VALIDATION", "1"}}, patience);
    const auto output = [&](int line) { return std::filesystem::exists(outputOf(line)) ? readText(outputOf(line)) : std::string(); };
    int failed = 0, code = shell.exitCode;
    std::istringstream(shell.out) >> failed >> code;
    if (shell.timedOut)
        for (const PageCommand& command : commands)
            if (std::filesystem::exists(outputOf(command.line))) failed = command.line;
    for (const PageCommand& command : commands) {
        const bool isLast = failed != 0 ? command.line == failed : !std::filesystem::exists(outputOf(command.line));
        if (!isLast) {
            ++result.commands;
            if (const std::string text = output(command.line); text.find("validation:") != text.npos)
                say(command.line, "`" + command.text + "` breaks Vulkan's rules:\n" + text);
            continue;
        }
        say(command.line,
            "`" + command.text + "` " + (shell.timedOut ? "takes too long" : "ended with " + std::to_string(code)) + ":\n" + output(command.line) + shell.err);
        return result;
    }
    if (shell.exitCode != 0) say(1, (shell.timedOut ? "takes too long\n" : "its shell failed\n") + shell.err);

    const std::regex word("[A-Za-z_][A-Za-z_]+");
    for (const Promise& promise : promises) {
        std::string printed;
        for (const int line : promise.commands) printed += output(line);
        for (std::sregex_iterator found(promise.text.begin(), promise.text.end(), word), none; found != none; ++found)
            if (printed.find(found->str()) == printed.npos) say(promise.line, "\"" + found->str() + "\" is promised, but what is printed is\n" + printed);
    }
    return result;
}

}  // namespace lodestir::test
