// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/part_list.h>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

std::string key_of(const ScenePart& part) {
    return str_cat(static_cast<uint32_t>(part.use), part.name, "\n", part.note);
}

/// The row of parts that are of too many kinds.
const ScenePart& other_parts() {
    static const ScenePart kOthers{
        PartUse::Ignored, "other parts", 0, {}, "are of more kinds than are listed", "", true};
    return kOthers;
}

void add_element(const std::string& element, ScenePart& part) {
    if (part.elements.size() < ScenePart::kMaxElements) part.elements.push_back(element);
}

}  // namespace

ScenePart& PartList::row(const ScenePart& part) {
    const bool has_row = rows_.size() < kMaxRows || rows_.contains(key_of(part));
    const ScenePart& kept = has_row ? part : other_parts();
    const auto [row, is_new] = rows_.emplace(key_of(kept), parts_.size());
    if (is_new) parts_.push_back(kept);
    return parts_[row->second];
}

void PartList::add(const ScenePart& part, const std::string& element) {
    ScenePart& added = row(part);
    ++added.count;
    add_element(element, added);
}

void PartList::add_left_out(const std::string& name, const std::string& note, bool changes_light,
                            const std::string& element) {
    add({PartUse::Ignored, name, 0, {}, note, "", changes_light}, element);
}

void PartList::add_count(ScenePart part, uint64_t count) {
    if (count > 0) row(part).count += count;
}

void PartList::append(const std::vector<ScenePart>& parts) {
    for (const ScenePart& part : parts) {
        ScenePart empty = part;
        empty.count = 0;
        empty.elements.clear();
        ScenePart& added = row(empty);
        added.count += part.count;
        for (const std::string& element : part.elements) add_element(element, added);
    }
}

std::string part_warning(const ScenePart& part) {
    std::string text = part.name;
    if (!part.elements.empty()) {
        text += " (";
        text += part.elements.front();
        if (part.count > 1) text += str_cat(" and ", part.count - 1, " more");
        text += ")";
    }
    text += ": ";
    text += part.note;
    if (!part.remedy.empty()) {
        text += "; ";
        text += part.remedy;
    }
    return text;
}

}  // namespace tetralight::detail
