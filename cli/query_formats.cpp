// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/query_formats.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace tetralight::cli {
namespace {

template <class Format>
struct Name {
    const char* name;
    Format format;
};

constexpr Name<PositionFormat> kPositionExtensions[] = {{".json", PositionFormat::JsonArray},
                                                        {".jsonl", PositionFormat::JsonLines},
                                                        {".f32", PositionFormat::Raw},
                                                        {".raw", PositionFormat::Raw},
                                                        {".bin", PositionFormat::Raw}};

constexpr Name<AnswerFormat> kAnswerExtensions[] = {
    {".txt", AnswerFormat::Text}, {".jsonl", AnswerFormat::JsonLines}, {".csv", AnswerFormat::Csv},
    {".f32", AnswerFormat::Raw},  {".raw", AnswerFormat::Raw},         {".bin", AnswerFormat::Raw}};

template <class Format, size_t N>
std::optional<Format> find(const Name<Format> (&table)[N], const std::string& name) {
    const auto found = std::ranges::find(table, name, &Name<Format>::name);
    if (found == std::end(table)) return std::nullopt;
    return found->format;
}

std::string extension_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
}

}  // namespace

PositionFormat position_format_of_file(const std::string& path) {
    return find(kPositionExtensions, extension_of(path)).value_or(PositionFormat::Text);
}

std::optional<AnswerFormat> answer_format_of_file(const std::string& path) {
    return find(kAnswerExtensions, extension_of(path));
}

}  // namespace tetralight::cli
