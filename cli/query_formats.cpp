// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/query_formats.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>

#include <tetralight/base/contract.h>

namespace tetralight::cli {
namespace {

template <class Format>
struct Name {
    const char* name;
    Format format;
};

constexpr Name<PositionFormat> kPositionNames[] = {{"text", PositionFormat::Text},
                                                   {"json", PositionFormat::Json},
                                                   {"jsonl", PositionFormat::JsonLines},
                                                   {"raw", PositionFormat::Raw}};

constexpr Name<PositionFormat> kPositionExtensions[] = {{".json", PositionFormat::Json},
                                                        {".jsonl", PositionFormat::JsonLines},
                                                        {".f32", PositionFormat::Raw},
                                                        {".raw", PositionFormat::Raw},
                                                        {".bin", PositionFormat::Raw}};

constexpr Name<AnswerFormat> kAnswerNames[] = {{"text", AnswerFormat::Text},
                                               {"jsonl", AnswerFormat::JsonLines},
                                               {"csv", AnswerFormat::Csv},
                                               {"raw", AnswerFormat::Raw}};

constexpr Name<AnswerFormat> kAnswerExtensions[] = {
    {".txt", AnswerFormat::Text}, {".jsonl", AnswerFormat::JsonLines}, {".csv", AnswerFormat::Csv},
    {".f32", AnswerFormat::Raw},  {".raw", AnswerFormat::Raw},         {".bin", AnswerFormat::Raw}};

template <class Format, size_t N>
std::vector<std::string> names_of(const Name<Format> (&table)[N]) {
    std::vector<std::string> names;
    for (const auto& entry : table) names.emplace_back(entry.name);
    return names;
}

template <class Format, size_t N>
std::optional<Format> find(const Name<Format> (&table)[N], const std::string& name) {
    const auto found = std::ranges::find(table, name, &Name<Format>::name);
    if (found == std::end(table)) return std::nullopt;
    return found->format;
}

std::string extension_of(const std::string& path) {
    return CLI::detail::to_lower(std::filesystem::path(path).extension().string());
}

}  // namespace

std::vector<std::string> position_format_names() {
    return names_of(kPositionNames);
}

std::vector<std::string> answer_format_names() {
    return names_of(kAnswerNames);
}

PositionFormat position_format(const std::string& name) {
    const auto format = find(kPositionNames, name);
    TETRALIGHT_ASSERT(format, "a word of --from");
    return *format;
}

AnswerFormat answer_format(const std::string& name) {
    const auto format = find(kAnswerNames, name);
    TETRALIGHT_ASSERT(format, "a word of --to");
    return *format;
}

PositionFormat position_format_of_file(const std::string& path) {
    return find(kPositionExtensions, extension_of(path)).value_or(PositionFormat::Text);
}

std::optional<AnswerFormat> answer_format_of_file(const std::string& path) {
    return find(kAnswerExtensions, extension_of(path));
}

}  // namespace tetralight::cli
