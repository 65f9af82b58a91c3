// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/answer_writer.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/position_reader.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/world.h>

namespace tetralight::cli {
namespace {

struct Query {
    std::string volume_path;
    std::string positions_path;
    std::string output;
    std::optional<PositionFormat> from;
    Normals normals = Normals::None;
    AnswerSettings settings;
    bool is_half = false;
    CommonOptions common;

    explicit Query(const Values& values)
        : volume_path(values.text("volume")),
          positions_path(values.text("positions")),
          output(values.text("output")),
          is_half(values.text("precision") == "half"),
          common(values) {
        if (values.is_given("from")) from = choice<PositionFormat>(values, "from");
        settings.format = answer_format(values);
        settings.outside.policy = choice<OutsidePolicy>(values, "outside");
        settings.outside.fade_distance = values.number32("fade");
        settings.receiver.walls = choice<Walls>(values, "walls");
        settings.receiver.rendering_layers = values.bits("rendering_layers", kAllRenderingLayers);
        settings.receiver.radius = values.number32("radius");
        settings.normal_offset = values.number32("normal_offset");
        if (values.flag("normals")) normals = Normals::Given;
        settings.thread_count = common.thread_count;
        if (values.is_given("fade") && settings.outside.policy != OutsidePolicy::Ambient) {
            refuse(values, "fade", "needs " + values.shown("outside") + " ambient");
        }
        if (values.is_given("normal_offset") && normals == Normals::None) {
            refuse(values, "normal_offset", "needs " + values.shown("normals"));
        }
    }

    /// Throws a `UsageError` if extension, `to` and `json` do not go together.
    [[nodiscard]] AnswerFormat answer_format(const Values& values) const {
        const std::string to = values.text("to");
        if (output == "-" && common.is_json && !to.empty() && to != "jsonl") {
            refuse(values, "to",
                   values.shown("json") + " writes JSON lines when the answers go to stdout");
        }
        const std::string extension = std::filesystem::path(output).extension().string();
        const auto by_extension = answer_format_of_file(output);
        if (!extension.empty() && !by_extension) {
            refuse(values, "output",
                   str_cat("cannot write \"", extension,
                           "\" files; the extension may be .txt, .jsonl, .csv, .f32, .raw or "
                           ".bin, or none"));
        }
        if (to.empty()) {
            const auto plain = common.is_json ? AnswerFormat::JsonLines : AnswerFormat::Text;
            return by_extension.value_or(plain);
        }
        const auto chosen = choice<AnswerFormat>(values, "to");
        if (by_extension && chosen != *by_extension) {
            refuse(values, "to", str_cat(to, " does not go with \"", extension, "\""));
        }
        return chosen;
    }

    Status run() {
        if (auto status = check_output(output, {volume_path, positions_path}); !status) {
            return status;
        }
        if (is_world(volume_path)) return run_world();
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        common.warn_if_unlit(volume_path, file->view());
        if (is_half && file->view().compact.empty()) {
            return Error{ErrorCode::InvalidArgument, "precision", "half",
                         volume_path + ": holds no half-precision probes; use --precision full"};
        }
        const ProbeVolumeView view = is_half ? file->view() : file->view().without_compact();
        return answer([&](FileWriter& writer) { return AnswerWriter(view, settings, writer); });
    }

    Status run_world() {
        if (normals == Normals::Given) {
            return Error{ErrorCode::InvalidArgument, "normals", "",
                         volume_path + ": is a world, which answers positions without normals"};
        }
        auto world = World::open(volume_path, {.is_verified = true});
        if (!world) return world.error();
        const auto precision = is_half ? WorldBatch::Precision::Fast : WorldBatch::Precision::Full;
        return answer(
            [&](FileWriter& writer) { return AnswerWriter(*world, precision, settings, writer); });
    }

    template <class MakeAnswers>
    Status answer(const MakeAnswers& make_answers) {
        const auto start = std::chrono::steady_clock::now();
        auto reader = ByteReader::open(positions_path);
        if (!reader) return reader.error();
        auto writer = FileWriter::open(output);
        if (!writer) return writer.error();
        AnswerWriter answers = make_answers(*writer);
        PositionChunks chunks(normals, [&](auto positions, auto with_normals) {
            return answers.write(positions, with_normals);
        });
        const PositionFormat format = from.value_or(position_format_of_file(positions_path));
        if (auto status = read_positions(*reader, format, chunks); !status) return status;
        if (auto status = answers.finish(); !status) return status;
        warn_of_not_finite(*reader, answers.not_finite_count());
        warn_of_lost(*reader, answers.lost_count());
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

    void warn_of_lost(const ByteReader& reader, uint64_t count) const {
        if (count == 0) return;
        common.warn({str_cat(reader.name(), ": the tiles of ", counted(count, "position"),
                             " do not have the cells that the search went through; ",
                             count == 1 ? "it" : "they", " got the ambient light")});
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

Status run_query(const Values& values) {
    return Query(values).run();
}

}  // namespace tetralight::cli
