// SPDX-License-Identifier: Apache-2.0
// The `tetralight` command. Exit codes: 0 fine, 1 bad data, 2 wrong usage, 130 and 143
// interrupted by Ctrl-C and SIGTERM.
#include <csignal>
#include <iostream>
#include <new>

#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/progress.h>
#ifdef TETRALIGHT_HAS_SERVER
#include <tetralight/base/error_text.h>
#include <tetralight/cli/serve.h>
#endif

namespace {

constexpr int kExitFine = 0;
constexpr int kExitBadData = 1;
constexpr int kExitUsage = 2;
constexpr int kExitSignal = 128;  // plus its number, as shells have it

/// What CLI11 says in a language of its own, as a plain sentence.
std::string plain(const std::string& message) {
    const std::string option = message.substr(0, message.find(':'));
    if (message.find(": At Most 1 required") != std::string::npos) {
        return option + " is given more than once";
    }
    const bool has_no_value = message.find(": 1 required ") != std::string::npos;
    return has_no_value ? option + " is given without a value" : message;
}

/// What is wrong with the arguments, and where to read on.
std::string usage_message(const CLI::App* app, const CLI::Error& error) {
    const auto chosen = app->get_subcommands();
    const std::string command = chosen.empty() ? "" : " " + chosen[0]->get_name();
    std::string message = plain(error.what());
    if (chosen.empty() && !app->remaining().empty()) {
        message = "there is no subcommand \"" + app->remaining()[0] + "\"";
    }
    return "tetralight" + command + ": " + message + "\nRun tetralight" + command +
           " --help for more information.\n";
}

void declare_commands(CLI::App& app, tetralight::cli::Run& run) {
    using namespace tetralight::cli;
    app.set_version_flag("--version", "tetralight " TETRALIGHT_VERSION);
    app.require_subcommand(1);
    app.failure_message(usage_message);
    add_grid(app, run);
    add_bake(app, run);
    add_merge(app, run);
    add_tetrahedralize(app, run);
    add_query(app, run);
    add_relight(app, run);
    add_lppv(app, run);
    add_render(app, run);
    add_meshball(app, run);
    add_info(app, run);
    add_validate(app, run);
#ifdef TETRALIGHT_HAS_SERVER
    add_serve(app, run);
#endif
}

int run_command(const tetralight::cli::Run& run) {
    const tetralight::Status status = run();
    if (!status) {
        std::cerr << "tetralight: " << tetralight::cli::printable(error_text(status.error()))
                  << '\n';
        const int signal = tetralight::cli::BakeProgressDisplay::interrupting_signal();
        return signal == 0 ? kExitBadData : kExitSignal + signal;
    }
    std::cout.flush();
    if (std::cout) return kExitFine;
    std::cerr << "tetralight: cannot write to stdout\n";
    return kExitBadData;
}

}  // namespace

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error like any other
    CLI::App app("Baked light probes for things that move: bake a glTF scene, query and render it.",
                 "tetralight");
    tetralight::cli::Run run;
    declare_commands(app, run);
    try {
        app.parse(argc, argv);
        return run_command(run);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kExitFine : kExitUsage;
    } catch (const std::bad_alloc&) {
        std::cerr << "tetralight: not enough memory\n";
        return kExitBadData;
    }
}
