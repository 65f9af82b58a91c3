// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/unity_groups.h>

#include <glm/vec4.hpp>
#include <unordered_set>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/text_file.h>
#include <tetralight/imports/detail/unity_file.h>
#include <tetralight/imports/detail/unity_places.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight {
namespace {

using detail::UnityFile;
using detail::UnityPlace;
using detail::UnityProbes;

std::string prefab_text(size_t count) {
    return str_cat(count,
                   count == 1 ? " prefab instance is not followed, and its probes are not read"
                              : " prefab instances are not followed, and their probes are not read",
                   "; in Unity, Unpack Prefab puts their objects into this file");
}

class UnityScene {
  public:
    UnityScene(const std::string& path, UnityFile file)
        : path_(path), file_(std::move(file)), places_(file_) {}

    UnityScene(const UnityScene&) = delete;
    UnityScene& operator=(const UnityScene&) = delete;

    Result<ImportedGroups> groups() {
        for (UnityProbes& probes : file_.probes) {
            if (auto status = add(probes); !status)
                return status.error().in(
                    str_cat(path_, ":", probes.line, ": LightProbeGroup ", probes.id));
        }
        if (file_.prefab_instance_count > 0)
            result_.warnings.push_back(
                str_cat(path_, ": ", prefab_text(file_.prefab_instance_count)));
        if (result_.groups.empty()) return none();
        return std::move(result_);
    }

  private:
    [[nodiscard]] Error none() const {
        const size_t prefab_count = file_.prefab_instance_count;
        std::string reason = "has no LightProbeGroup";
        if (!first_left_out_.empty())
            reason += " that can be read: " + first_left_out_;
        else if (prefab_count > 0)
            reason += "; " + prefab_text(prefab_count);
        return {ErrorCode::NotFound, "groups", path_, str_cat(path_, ": ", reason)};
    }

    Status add(UnityProbes& probes) {
        const auto place = places_.place(probes.object);
        if (!place) return place.error();
        std::string path = places_.path_of(probes.object);
        if (const char* const reason = reason_to_leave_out(probes, *place)) {
            const std::string text =
                str_cat("that of ", detail::quoted_text(path), " is left out: ", reason);
            if (first_left_out_.empty()) first_left_out_ = text;
            result_.warnings.push_back(str_cat(path_, ": LightProbeGroup: ", text));
            return Ok{};
        }
        return add_group(probes, *place, std::move(path));
    }

    static const char* reason_to_leave_out(const UnityProbes& probes, const UnityPlace& place) {
        if (!place.is_in_file)
            return "it belongs to a prefab instance, or is below one, and its place is not in this "
                   "file";
        if (!place.is_active) return "the object or a parent is not active";
        return probes.is_enabled ? nullptr : "the component is off";
    }

    Status add_group(UnityProbes& probes, const UnityPlace& place, std::string name) {
        if (name.empty() || names_.contains(name))
            name += str_cat(name.empty() ? "#" : " #", probes.id);
        if (auto status = detail::check_group_name(name); !status) return status;
        if (!names_.insert(name).second) {
            return Error{ErrorCode::Corrupt, "m_Name", name.substr(0, 60),
                         str_cat("another group is named ", detail::quoted_text(name))};
        }
        for (size_t i = 0; i < probes.positions.size(); ++i) {
            glm::dvec3& p = probes.positions[i];
            p = glm::dvec3(place.world_from_object * glm::dvec4(p, 1.0));
            p.x = -p.x;
            if (is_finite(p)) continue;
            return Error{ErrorCode::Corrupt, "m_SourcePositions", "",
                         str_cat("probe ", i, ": its position in the world is not finite (", p.x,
                                 ", ", p.y, ", ", p.z, ")")};
        }
        ProbeGroup group{
            .name = name, .positions = std::move(probes.positions), .dering = probes.dering};
        if (group.positions.empty())
            group.empty_warning = str_cat(path_, ": the LightProbeGroup of ",
                                          detail::quoted_text(name), " has no probes");
        result_.groups.push_back(std::move(group));
        return Ok{};
    }

    std::string path_;
    UnityFile file_;
    detail::UnityPlaces places_;
    std::unordered_set<std::string> names_;
    ImportedGroups result_;
    std::string first_left_out_;
};

}  // namespace

Result<ImportedGroups> read_unity_groups(const std::string& path) {
    const auto text = detail::TextFile::open(path);
    if (!text) return text.error();
    auto file = detail::parse_unity_file(text->text());
    if (!file) {
        Error error = file.error();
        error.message = error.message.prefixed(path + ":");
        return error;
    }
    return UnityScene(path, std::move(*file)).groups();
}

}  // namespace tetralight
