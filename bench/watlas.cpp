// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/watlas.h>

#include <array>
#include <cstddef>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include <tetralight/base/process/process.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {
namespace {

constexpr int kExitNotInstalled = 77;

}  // namespace

std::optional<WatlasResult> unwrap_with_watlas(std::span<const UnwrapShape> shapes,
                                               double texels_per_meter, int runs) {
    std::vector<std::array<uint32_t, 2>> sizes(shapes.size());
    std::vector<std::span<const std::byte>> input;
    for (size_t i = 0; i < shapes.size(); ++i) {
        sizes[i] = {static_cast<uint32_t>(shapes[i].positions.size()),
                    static_cast<uint32_t>(shapes[i].indices.size())};
        input.push_back(std::as_bytes(std::span(sizes[i])));
        input.push_back(std::as_bytes(std::span(shapes[i].positions)));
        input.push_back(std::as_bytes(shapes[i].indices));
    }
    ProcessCommand command;
    command.program = "node";
    command.arguments = {TETRALIGHT_SOURCE_DIR "/viewer/bench/watlas.mjs",
                         std::to_string(texels_per_meter), std::to_string(runs)};
    command.input = input;
    const auto result = run_process(command);
    if (!result ||
        (result->end == ProcessResult::End::Exited && result->code == kExitNotInstalled)) {
        std::cerr << "skipped: the baseline of lightmap.charts and lightmap.unwrap needs watlas "
                     "(npm ci --prefix viewer)\n";
        return std::nullopt;
    }
    require(result->succeeded(), "watlas " + result->errors);
    const auto json = nlohmann::json::parse(result->output_text());
    return WatlasResult{json.at("charts"), json.at("cpu_seconds")};
}

}  // namespace tetralight::bench
