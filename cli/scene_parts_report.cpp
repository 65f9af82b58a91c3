// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/scene_parts_report.h>

#include <algorithm>
#include <iterator>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/table.h>

namespace tetralight::cli {
namespace {

/// So that a line has room for the other columns.
constexpr size_t kLongestPartName = 48;
constexpr size_t kDetailIndent = 6;

std::vector<ScenePart> sorted_by_use(std::vector<ScenePart> parts) {
    std::ranges::stable_sort(parts, {}, &ScenePart::use);
    return parts;
}

const char* use_word(PartUse use) {
    constexpr const char* kWords[] = {"read", "approximated", "ignored"};
    return kWords[static_cast<size_t>(use)];
}

/// "ignored, changes the light".
std::string use_text(const ScenePart& part) {
    const bool differs = part.changes_light && part.use != PartUse::Read;
    return str_cat(use_word(part.use), differs ? ", changes the light" : "");
}

/// "node 1 \"door\", node 2 \"gate\" and 5 more: NOTE".
std::string elements_text(const ScenePart& part) {
    std::string text;
    for (const std::string& element : part.elements) {
        text += (text.empty() ? "" : ", ") + element;
    }
    if (!text.empty() && part.count > part.elements.size())
        text += str_cat(" and ", grouped(part.count - part.elements.size()), " more");
    return text + (text.empty() || part.note.empty() ? "" : ": ") + part.note;
}

/// A paragraph below a row.
void append_detail(std::string& text, const std::string& detail) {
    if (detail.empty()) return;
    text.append(kDetailIndent, ' ');
    append_wrapped(text, printable(detail), kDetailIndent);
}

void append_details(std::string& text, const ScenePart& part) {
    append_detail(text, elements_text(part));
    if (!part.remedy.empty()) append_detail(text, "Remedy: " + part.remedy);
}

bool tells_of(const std::string& warning, const ScenePart& part) {
    return part.changes_light && warning.find(part.name) != warning.npos &&
           warning.find(part.note) != warning.npos;
}

}  // namespace

settings::Json parts_json(const std::vector<ScenePart>& parts) {
    Json rows = Json::array();
    for (const ScenePart& part : sorted_by_use(parts)) {
        rows.push_back({{"use", use_word(part.use)},
                        {"name", part.name},
                        {"count", part.count},
                        {"elements", part.elements},
                        {"note", part.note},
                        {"remedy", part.remedy},
                        {"changes_light", part.changes_light}});
    }
    return rows;
}

std::string parts_text(const std::vector<ScenePart>& parts) {
    if (parts.empty()) return "";
    const std::vector<ScenePart> sorted = sorted_by_use(parts);
    std::vector<std::vector<std::string>> rows{{"part", "count", "use"}};
    for (const ScenePart& part : sorted) {
        rows.push_back({shortened(printable(part.name), kLongestPartName), grouped(part.count),
                        use_text(part)});
    }
    const std::string lines = aligned(rows, "lrl");
    std::string text = "what was read\n";
    size_t begin = 0;
    for (size_t i = 0; i < rows.size(); ++i) {
        const size_t end = lines.find('\n', begin) + 1;
        text += lines.substr(begin, end - begin);
        if (i > 0) append_details(text, sorted[i - 1]);
        begin = end;
    }
    return text;
}

std::vector<std::string> warnings_beside_parts(const Scene& scene) {
    std::vector<std::string> warnings;
    std::ranges::copy_if(
        scene.warnings, std::back_inserter(warnings), [&](const std::string& warning) {
            return std::ranges::none_of(
                scene.parts, [&](const ScenePart& part) { return tells_of(warning, part); });
        });
    return warnings;
}

}  // namespace tetralight::cli
