// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/earlier_light.h>

#include <filesystem>
#include <optional>
#include <span>

#include <tetralight/base/hex.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/json_file.h>
#include <tetralight/probes/content_hash.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

/// The weights that make light of strengths `baked` one of `now`; none if layers differ.
std::optional<Json> weights_of(const Json& baked, const Json& now) {
    if (!baked.is_object() || baked.empty() || baked.size() != now.size()) return std::nullopt;
    Json weights = Json::object();
    for (const auto& [layer, strength] : now.items()) {
        const auto before = baked.find(layer);
        const bool is_lit =
            before != baked.end() && before->is_number() && before->get<double>() > 0.0;
        if (!is_lit) return std::nullopt;
        weights[layer] = strength.get<double>() / before->get<double>();
    }
    return weights;
}

Status keep_file(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    if (!error) fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
    if (!error) return Ok{};
    return Error{ErrorCode::Unavailable, "output", to.string(),
                 str_cat(to.string(), ": cannot be written: ", error.message())};
}

}  // namespace

Json lamps_json(const LampStrengths& lamps, const std::string& content) {
    ContentHash hash;
    hash.add(lamps.scene_key);
    hash.add_bytes(std::as_bytes(std::span(content)));
    return {{"key", hex(hash.value())}, {"strengths", lamps.strengths}};
}

Result<bool> take_earlier_light(const std::string& job, const std::string& folder,
                                PlanResult& result) {
    const fs::path earlier = fs::path(folder) / result.file;
    const Json record = read_object(fs::path(job) / "done" / result.record_name());
    std::error_code ignored;
    const bool is_there = fs::is_regular_file(earlier, ignored) &&
                          record.value("output", Json()) == earlier.string() &&
                          record.value("bytes", Json()) == fs::file_size(earlier, ignored);
    const Json lamps = record.value("lamps", Json());
    if (!is_there || !lamps.is_object() || record.value("key", Json()) == result.key ||
        lamps.value("key", Json()) != result.lamps["key"])
        return false;
    auto weights = weights_of(lamps.value("strengths", Json()), result.lamps["strengths"]);
    if (!weights) return false;
    const std::string kept = str_cat("earlier/", result.file);
    if (auto status = keep_file(earlier, fs::path(job) / kept); !status) return status.error();
    result.command = {{"command", "relight"}, {"volume", kept}, {"weights", std::move(*weights)}};
    result.lamps["strengths"] = lamps["strengths"];
    result.bytes = record["bytes"].get<size_t>();
    return true;
}

}  // namespace tetralight::cli
