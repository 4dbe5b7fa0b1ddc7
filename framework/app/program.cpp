// SPDX-License-Identifier: MIT
#include <framework/app/program.h>

#include <framework/app/command_line.h>
#include <framework/app/commands/commands.h>
#include <framework/core/error.h>

#include <CLI/CLI.hpp>
#include <lodestir/revision.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <system_error>

namespace lodestir {

int runProgram(int argc, char** argv) {
    CLI::App app("Lodestir: render graphs of exchangeable passes for real-time path tracing across levels of detail.", "lodestir");
    app.set_version_flag("--version", std::string(LODESTIR_VERSION) + " (" + LODESTIR_REVISION + ")");
    app.require_subcommand(1);
    app.failure_message(CLI::FailureMessage::simple);
    std::function<int()> run;
    for (AddCommand* add : allCommands) add(app, run);
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
    if (argc > 1 && argv[1][0] != '-' && std::ranges::find(names, std::string_view(argv[1])) == names.end()) {
        std::fprintf(stderr, "lodestir: no command \"%s\"; %s\n", argv[1], didYouMean(argv[1], names).c_str());
        return 2;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool wrong = error.get_exit_code() != 0;
        if (const std::string unexpected = wrong ? unexpectedArguments(app) : ""; !unexpected.empty()) {
            std::fprintf(stderr, "%s\n", unexpected.c_str());
            return 2;
        }
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        const int code = run();
        // A full disk behind `> facts.json` is only noticed here, and half the facts are worse than none.
        if (std::fflush(stdout) != 0 || std::ferror(stdout))
            throw Error("what was printed cannot be written: " + std::generic_category().message(errno));
        return code;
    } catch (const CLI::ParseError& error) {  // found wrong only when the command looked closer
        app.exit(error);
        return 2;
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "lodestir: out of memory\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "lodestir: %s\n", error.what());
    }
    return 1;
}

}  // namespace lodestir
