// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/part_list.h>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

std::string key_of(const ScenePart& part) {
    return str_cat(static_cast<uint32_t>(part.use), part.name, "\n", part.note);
}

}  // namespace

ScenePart& PartList::row(const ScenePart& part) {
    if (parts_.size() == kMaxRows - 1 && !rows_.contains(key_of(part))) {
        ScenePart others;
        others.use = PartUse::Ignored;
        others.name = "other parts";
        others.note = "are of more kinds than are listed";
        others.changes_light = true;
        rows_.emplace(key_of(others), parts_.size());
        parts_.push_back(others);
    }
    if (parts_.size() >= kMaxRows) {
        const auto known = rows_.find(key_of(part));
        return parts_[known == rows_.end() ? kMaxRows - 1 : known->second];
    }
    const auto [row, is_new] = rows_.emplace(key_of(part), parts_.size());
    if (is_new) parts_.push_back(part);
    return parts_[row->second];
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
