// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/part_list.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {

ScenePart& PartList::row(const ScenePart& part) {
    const auto found = std::ranges::find_if(parts_, [&](const ScenePart& other) {
        return other.name == part.name && other.use == part.use && other.note == part.note;
    });
    return found != parts_.end() ? *found : parts_.emplace_back(part);
}

void PartList::add(const ScenePart& part, const std::string& element) {
    ScenePart& added = row(part);
    ++added.count;
    if (added.elements.size() < ScenePart::kMaxElements) added.elements.push_back(element);
}

void PartList::add_left_out(const std::string& name, const std::string& note, bool changes_light,
                            const std::string& element) {
    ScenePart part;
    part.use = PartUse::Ignored;
    part.name = name;
    part.note = note;
    part.changes_light = changes_light;
    add(part, element);
}

void PartList::add_count(ScenePart part, uint64_t count) {
    if (count > 0) row(part).count += count;
}

void PartList::append(const std::vector<ScenePart>& parts) {
    parts_.insert(parts_.end(), parts.begin(), parts.end());
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
