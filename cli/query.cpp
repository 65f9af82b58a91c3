// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/answer_writer.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/position_reader.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

struct Query {
    std::string volume_path;
    std::string positions_path = "-";
    std::string output = "-";
    std::string from;
    std::string to;
    std::string outside = "extrapolate";
    OutsideHull outside_hull;
    std::string precision = "full";
    CLI::Option* fade_option = nullptr;
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "VOLUME", volume_path, "Probe volume (.probes)")->required();
        add_path(command, "POSITIONS", positions_path,
                 "Positions, by default x y z a line; - = stdin")
            ->capture_default_str();
        add_path(command, "-o,--output", output, "File for the answers; - = stdout")
            ->capture_default_str();
        add_formats(command);
        command
            .add_option("--outside", outside,
                        "Light outside the hull of the probes: that of the hull carried outwards, "
                        "that of its closest point, or the latter fading to ambient light")
            ->check(CLI::IsMember({"extrapolate", "clamp", "ambient"}))
            ->capture_default_str();
        fade_option = command.add_option("--fade", outside_hull.fade_distance,
                                         "Metres over which --outside ambient fades");
        fade_option->check(numbers_in(1e-6, 1e9))->capture_default_str();
        command
            .add_option("--precision", precision,
                        "Read the probes as floats (full) or as their compact half-precision "
                        "copies (half)")
            ->check(CLI::IsMember({"full", "half"}))
            ->capture_default_str();
        common.add_to(command);
        command.parse_complete_callback([this] { check_options(); });
    }

    void add_formats(CLI::App& command) {
        command
            .add_option("--from", from,
                        "Format of the positions (default: by the extension, .json, .jsonl, .f32, "
                        ".raw or .bin; else text)")
            ->check(CLI::IsMember(position_format_names()));
        command
            .add_option("--to", to,
                        "Format of the answers (default: by the extension, .txt, .jsonl, .csv, "
                        ".f32, .raw or .bin; else JSON lines with --json, text without)")
            ->check(CLI::IsMember(answer_format_names()));
    }

    void check_options() const {
        if (output == "-" && common.is_json && !to.empty() && to != "jsonl") {
            throw CLI::ValidationError("--to", "--json makes JSON lines of answers to stdout");
        }
        if (fade_option->count() > 0 && outside != "ambient") {
            throw CLI::ValidationError("--fade", "needs --outside ambient");
        }
        check_extension();
    }

    void check_extension() const {
        const std::string extension = std::filesystem::path(output).extension().string();
        if (extension.empty()) return;
        const auto format = answer_format_of_file(output);
        if (!format) {
            throw CLI::ValidationError(
                "--output",
                str_cat("cannot write \"", extension,
                        "\" files; the extension may be .txt, .jsonl, .csv, .f32, .raw or "
                        ".bin, or none"));
        }
        if (!to.empty() && answer_format(to) != *format) {
            throw CLI::ValidationError("--to",
                                       str_cat(to, " does not go with \"", extension, "\""));
        }
    }

    [[nodiscard]] AnswerSettings settings() const {
        AnswerSettings settings;
        settings.format = common.is_json ? AnswerFormat::JsonLines : AnswerFormat::Text;
        if (const auto format = answer_format_of_file(output)) settings.format = *format;
        if (!to.empty()) settings.format = answer_format(to);
        settings.outside = outside_hull;
        if (outside == "clamp") settings.outside.policy = OutsidePolicy::Clamp;
        if (outside == "ambient") settings.outside.policy = OutsidePolicy::Ambient;
        settings.thread_count = common.thread_count;
        return settings;
    }

    Status run() {
        if (auto status = check_output(output, {volume_path, positions_path}); !status) {
            return status;
        }
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        common.warn_if_unlit(volume_path, file->view());
        const bool is_half = precision == "half";
        if (is_half && file->view().compact.empty()) {
            return Error{volume_path + ": holds no half-precision probes; use --precision full"};
        }
        return answer(is_half ? file->view() : file->view().without_compact());
    }

    Status answer(const ProbeVolumeView& volume) {
        const auto start = std::chrono::steady_clock::now();
        auto reader = ByteReader::open(positions_path);
        if (!reader) return reader.error();
        auto writer = FileWriter::open(output);
        if (!writer) return writer.error();
        AnswerWriter answers(volume, settings(), *writer);
        PositionChunks chunks([&](auto positions) { return answers.write(positions); });
        const auto format =
            from.empty() ? position_format_of_file(positions_path) : position_format(from);
        if (auto status = read_positions(*reader, format, chunks); !status) return status;
        if (auto status = answers.finish(); !status) return status;
        warn_of_not_finite(*reader, answers.not_finite_count());
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        if (output != "-") report(answers, elapsed.count());
        return Ok{};
    }

    void warn_of_not_finite(const ByteReader& reader, uint64_t count) const {
        if (count == 0) return;
        common.warn(
            {str_cat(reader.name(), ": ", counted(count, "position"), count == 1 ? " is" : " are",
                     " not finite and got the ambient light")});
    }

    void report(const AnswerWriter& answers, double seconds) const {
        common.report(output,
                      {{"output", output},
                       {"answers", answers.answer_count()},
                       {"not_finite", answers.not_finite_count()},
                       {"seconds", seconds}},
                      str_cat(output, ": ", counted(answers.answer_count(), "answer"), " in ",
                              duration(seconds)));
    }
};

}  // namespace

void add_query(CLI::App& app, Run& run) {
    add_command<Query>(app, run, "query", "Say what light arrives at positions",
                       "echo 0 1 0 | tetralight query courtyard.probes --json\n"
                       "  tetralight query courtyard.probes positions.f32 -o light.csv");
}

}  // namespace tetralight::cli
