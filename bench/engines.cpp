// SPDX-License-Identifier: Apache-2.0
// How far the light that engines show is from the volume's, what exports take, and how fast the
// npm package answers.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <span>

#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/base/process/process.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/harness.h>
#include <tetralight/bench/query_subject.h>
#include <tetralight/engines/export_target.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::bench {
namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

/// Three digits.
double rounded(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return std::strtod(text.data(), nullptr);
}

Json quantiles_json(const DifferenceQuantiles& quantiles) {
    return {{"p50", rounded(quantiles.median)},
            {"p99", rounded(quantiles.p99)},
            {"p999", rounded(quantiles.p999)},
            {"worst", rounded(quantiles.worst)}};
}

void report_difference(const std::string& figure, const LightDifference& difference) {
    const Json line{{"figure", figure},
                    {"ours", quantiles_json(difference.from_light)},
                    {"without_walls", quantiles_json(difference.without_walls)},
                    {"places", difference.place_count},
                    {"unit", "of the largest irradiance"}};
    std::cout << line.dump() << std::endl;
}

/// Seconds of an export with measuring its difference, its size, and the difference of targets that
/// show other light than the volume's.
void exports(const Subject& subject, const Options& options) {
    const ProbeVolumeView volume = subject.volume.view();
    for (const ExportTarget& target : export_targets()) {
        std::vector<double> times;
        std::optional<LightDifference> difference;
        double bytes = 0.0;
        for (int i = 0; i < std::min(options.repetitions, 3); ++i) {
            times.push_back(seconds([&] {
                const auto exported = target.make(volume, {.name = "bench"});
                require(bool(exported), target.name);
                difference = exported->difference;
                bytes = 0.0;
                for (const ExportedFile& file : exported->files) {
                    bytes += static_cast<double>(file.content.size());
                }
            }));
        }
        const std::string name = str_cat('.', target.name, '.', subject.name);
        report("engines.seconds" + name, median(times), "s");
        report("engines.bytes" + name, bytes, "B");
        if (difference) report_difference("engines.difference" + name, *difference);
    }
}

/// A folder that is removed again.
struct BenchFolder {
    fs::path path = fs::temp_directory_path() / str_cat("tetralight_bench_engines_", getpid());

    BenchFolder() { fs::create_directories(path); }

    BenchFolder(const BenchFolder&) = delete;
    BenchFolder& operator=(const BenchFolder&) = delete;

    ~BenchFolder() { fs::remove_all(path); }
};

/// One position after the other, without hints: the code of single queries, which has no vector
/// instructions.
std::vector<IrradianceSh> single_answers(const ProbeVolumeView& volume,
                                         const std::vector<glm::vec3>& positions) {
    std::vector<IrradianceSh> answers(positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        answers[i] = interpolate(volume, locate(volume, positions[i])).irradiance;
    }
    return answers;
}

template <class Value>
void write_values(const fs::path& path, const std::vector<Value>& values) {
    require(bool(write_file(path.string(), std::as_bytes(std::span(values)))), "write");
}

/// Seconds of a batch by a script of packages/js/bench in Node, which compares its answers, too;
/// none if it cannot run. `last`: the script's argument after the folder.
std::optional<double> batch_in_node(const char* figure, const char* script_name,
                                    const BenchFolder& folder, const std::string& last) {
    const std::string script = str_cat(TETRALIGHT_SOURCE_DIR "/packages/js/bench/", script_name);
    const auto result =
        run_process({.program = "node", .arguments = {script, folder.path.string(), last}});
    if (!result || !result->succeeded()) {
        std::cerr << figure
                  << " is left out: " << (result ? result->failure() : error_text(result.error()))
                  << '\n';
        return std::nullopt;
    }
    const auto json = Json::parse(result->output_text());
    require(json["largest_difference"] <= 1e-4, "Node: other answers");
    return json["seconds"].get<double>();
}

constexpr size_t kNodeCount = 200'000;

/// `seconds_in_node` against single queries of one thread. Nothing if it returns nothing.
template <class SecondsInNode>
void contest_in_node(const std::string& figure, const ProbeVolumeView& view,
                     const std::vector<glm::vec3>& positions, const Options& options,
                     SecondsInNode seconds_in_node) {
    std::vector<double> ours;
    std::vector<double> baseline;
    for (int i = 0; i < options.repetitions; ++i) {
        const auto node = seconds_in_node();
        if (!node) return;
        ours.push_back(1e-6 * kNodeCount / *node);
        std::vector<IrradianceSh> answers;
        baseline.push_back(1e-6 * kNodeCount /
                           seconds([&] { answers = single_answers(view, positions); }));
    }
    report_contest(figure, median(ours), median(baseline), "Mq/s",
                   "C++ locate and interpolate, one position a call, one thread");
}

/// The npm package in Node.
void js_batch(Subject& subject, const Options& options) {
    const BenchFolder folder;
    const ProbeVolumeView half = subject.volume.view();
    require(bool(write_probe_file((folder.path / "volume.probes").string(), half)), "write");
    const auto positions = subject.positions(kNodeCount);
    write_values(folder.path / "positions.f32", positions);
    for (const char* precision : {"full", "half"}) {
        const bool is_full = std::string_view(precision) == "full";
        const ProbeVolumeView view = is_full ? half.without_compact() : half;
        write_values(folder.path / "answers.f32", single_answers(view, positions));
        contest_in_node(str_cat("js.batch.", subject.name, is_full ? "" : ".half"), view, positions,
                        options,
                        [&] { return batch_in_node("js.batch", "batch.mjs", folder, precision); });
    }
}

/// The WebAssembly module in Node, with the light as floats: that of `./run portability wasm32`.
void wasm_batch(Subject& subject, const Options& options) {
    const BenchFolder folder;
    const std::string module =
        TETRALIGHT_SOURCE_DIR "/build/portability/wasm32/runtime/wasm/tetralight.wasm";
    const ProbeVolumeView view = subject.volume.view().without_compact();
    require(bool(write_probe_file((folder.path / "volume.probes").string(), view)), "write");
    const auto positions = subject.positions(kNodeCount);
    write_values(folder.path / "positions.f32", positions);
    write_values(folder.path / "answers.f32", single_answers(view, positions));
    contest_in_node(str_cat("wasm.batch.", subject.name), view, positions, options,
                    [&] { return batch_in_node("wasm.batch", "wasm_batch.mjs", folder, module); });
}

}  // namespace

void bench_engines(const Options& options) {
    exports(make_scene_subject(options), options);
    Subject subject = make_random_subject("20k", 20'000);
    js_batch(subject, options);
    wasm_batch(subject, options);
}

}  // namespace tetralight::bench
