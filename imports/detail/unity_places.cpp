// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/unity_places.h>

#include <string_view>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/text_file.h>

namespace tetralight::detail {
namespace {

/// Of the prefab instance that a stripped transform belongs to.
constexpr std::string_view kStrippedName = "(prefab instance)";

glm::dmat4 matrix_of(const UnityTransform& transform) {
    const glm::dvec4& q = transform.rotation;
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    glm::dmat4 matrix(1.0);
    matrix[0] = glm::dvec4(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0) *
                transform.scale.x;
    matrix[1] = glm::dvec4(2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0) *
                transform.scale.y;
    matrix[2] = glm::dvec4(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0) *
                transform.scale.z;
    matrix[3] = glm::dvec4(transform.position, 1.0);
    return matrix;
}

Error not_in_file(const char* field, std::string_view what, UnityId id) {
    return {ErrorCode::Corrupt, field, str_cat(id), str_cat(what, " ", id, " is not in the file")};
}

}  // namespace

Result<UnityPlace> UnityPlaces::place(UnityId object) {
    const auto found = file_.objects.find(object);
    if (found == file_.objects.end())
        return not_in_file("m_GameObject", "the object with ID", object);
    const auto transform = file_.transform_of_object.find(object);
    if (transform != file_.transform_of_object.end()) return place_transform(transform->second);
    if (found->second.is_stripped) return UnityPlace{.is_in_file = false};
    return not_in_file("m_GameObject", "the transform of object", object);
}

Result<std::vector<UnityId>> UnityPlaces::unplaced_parents(UnityId transform) const {
    std::vector<UnityId> chain;
    for (UnityId id = transform; id != 0 && !placed_.contains(id);) {
        const auto found = file_.transforms.find(id);
        if (found == file_.transforms.end()) return not_in_file("m_Father", "transform", id);
        if (chain.size() == file_.transforms.size()) {
            return Error{ErrorCode::Corrupt, "m_Father", str_cat(id),
                         str_cat("line ", found->second.line, ": transform ", id,
                                 " is its own parent or that of one of its parents")};
        }
        chain.push_back(id);
        id = found->second.parent;
    }
    return chain;
}

Result<UnityPlace> UnityPlaces::place_in(const UnityPlace& parent,
                                         const UnityTransform& transform) const {
    if (transform.is_stripped) return UnityPlace{.is_in_file = false};
    const auto object = file_.objects.find(transform.object);
    if (object == file_.objects.end())
        return not_in_file("m_GameObject", str_cat("line ", transform.line, ": object"),
                           transform.object);
    return UnityPlace{parent.world_from_object * matrix_of(transform),
                      parent.is_active && object->second.is_active, parent.is_in_file};
}

Result<UnityPlace> UnityPlaces::place_transform(UnityId transform) {
    const auto chain = unplaced_parents(transform);
    if (!chain) return chain.error();
    for (auto id = chain->rbegin(); id != chain->rend(); ++id) {
        const UnityTransform& part = file_.transforms.at(*id);
        const auto parent = placed_.find(part.parent);
        const auto place = place_in(parent == placed_.end() ? UnityPlace{} : parent->second, part);
        if (!place) return place;
        placed_.emplace(*id, *place);
    }
    return placed_.at(transform);
}

std::string UnityPlaces::path_of(UnityId object) const {
    const UnityObject& last = file_.objects.at(object);
    std::vector<std::string_view> names = {last.is_stripped ? kStrippedName : last.name};
    size_t length = names[0].size();
    const auto own = file_.transform_of_object.find(object);
    UnityId id =
        own == file_.transform_of_object.end() ? 0 : file_.transforms.at(own->second).parent;
    while (id != 0 && length <= kLongestGroupName) {
        const UnityTransform& transform = file_.transforms.at(id);
        const auto found = file_.objects.find(transform.object);
        names.emplace_back(transform.is_stripped ? kStrippedName : found->second.name);
        length += names.back().size() + 1;
        id = transform.parent;
    }
    std::string path;
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
        if (name != names.rbegin()) path += '/';
        path += name->substr(0, kLongestGroupName + 1);
    }
    return path;
}

}  // namespace tetralight::detail
