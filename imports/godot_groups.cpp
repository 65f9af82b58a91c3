// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/godot_groups.h>

#include <algorithm>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/godot_nodes.h>
#include <tetralight/imports/detail/godot_text.h>
#include <tetralight/imports/detail/text_file.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight {
namespace {

using detail::GodotEntry;
using detail::GodotNode;
using detail::GodotNodeText;

std::string node_place(const GodotNodeText& node) {
    return str_cat(node.line, ": node ", detail::quoted_text(node.name));
}

/// Versions of the format: 3 and 4 are Godot 4's.
Status check_format(const GodotEntry& heading) {
    if (heading.name != "gd_scene")
        return Error{ErrorCode::Corrupt, str_cat(heading.line,
                                                 ": is not a text scene of Godot, which "
                                                 "begins with [gd_scene]")};
    const std::string_view text = heading.attribute("format").value_or("");
    if (text == "3" || text == "4") return Ok{};
    return Error{
        ErrorCode::Unsupported, "format", std::string(text.substr(0, 60)),
        str_cat(heading.line, ": format is ", text.empty() ? "missing" : detail::quoted_text(text),
                "; scenes of Godot 4 have 3 or 4")};
}

/// The file of an instanced scene may have probes: scenes may, models may not.
bool may_have_probes(std::string_view file) {
    return file.empty() || file.ends_with(".tscn") || file.ends_with(".scn");
}

class GodotScene {
  public:
    Status add(const GodotEntry& entry) {
        if (!entry.is_heading) return add_property(entry);
        if (auto status = finish_node(); !status) return status;
        if (entry.name == "ext_resource") return add_resource(entry);
        if (entry.name == "node") return begin_node(entry);
        return Ok{};
    }

    /// Adds the node whose properties are complete.
    Status finish_node() {
        if (!open_) return Ok{};
        const GodotNodeText text = std::move(*open_);
        open_.reset();
        const auto index = nodes_.add(text);
        if (!index) return index.error().in(node_place(text));
        if (text.type != "LightmapProbe") return Ok{};
        auto status = add_probe(*index, text.is_top_level);
        return status ? status : status.error().in(node_place(text));
    }

    [[nodiscard]] ImportedGroups take(const std::string& path) {
        return {std::move(groups_), warnings(path)};
    }

    /// Begins with a separator; empty if all scenes are in the file.
    [[nodiscard]] std::string why_none() const {
        return instance_count_ == 0 ? "" : str_cat("; ", instances_text());
    }

  private:
    Status add_resource(const GodotEntry& entry) {
        const auto file = entry.text_attribute("path");
        if (!file) return file.error().in(str_cat(entry.line, ": ext_resource"));
        // Ids are strings in Godot 4 and numbers before.
        if (const auto id = entry.attribute("id"))
            file_of_id_[std::string(id->substr(0, 256))] = file->value_or("").substr(0, 256);
        return Ok{};
    }

    Status begin_node(const GodotEntry& entry) {
        GodotNodeText& node = open_.emplace();
        node.line = entry.line;
        const auto name = entry.text_attribute("name");
        const auto type = entry.text_attribute("type");
        const auto parent = entry.text_attribute("parent");
        for (const auto* attribute : {&name, &type, &parent})
            if (!*attribute) return attribute->error().in(str_cat(entry.line, ": node"));
        if (!*name || (*name)->empty())
            return Error{ErrorCode::Corrupt, "name", "", str_cat(entry.line, ": node has no name")};
        node.name = **name;
        node.type = type->value_or("");
        node.parent = *parent;
        const auto instance = entry.attribute("instance");
        node.is_instance = instance || entry.attribute("instance_placeholder");
        if (node.is_instance) add_instance(instance.value_or(""));
        return Ok{};
    }

    /// `ExtResource("1_lamp")`.
    void add_instance(std::string_view value) {
        const size_t begin = value.find('(');
        const size_t end = value.rfind(')');
        std::string id;
        if (begin != std::string_view::npos && end != std::string_view::npos && begin < end)
            id = value.substr(begin + 1, std::min<size_t>(end - begin - 1, 256));
        const auto found = file_of_id_.find(id);
        const std::string file = found == file_of_id_.end() ? "" : found->second;
        if (!may_have_probes(file)) return;
        ++instance_count_;
        if (!file.empty() && files_.size() < kMostFiles + 1) files_.insert(file);
    }

    Status add_property(const GodotEntry& entry) {
        if (!open_) return Ok{};
        if (entry.name == "top_level") open_->is_top_level = entry.value == "true";
        if (entry.name != "transform") return Ok{};
        const auto transform = detail::parse_godot_transform(entry.value);
        if (!transform)
            return transform.error().in(
                str_cat(entry.line, ": node ", detail::quoted_text(open_->name)));
        open_->parent_from_node = *transform;
        return Ok{};
    }

    /// The group of a probe: that of the probe's parent. The root and probes in world space are
    /// groups of their own.
    Result<size_t> group_of(uint32_t probe, bool is_alone) {
        const uint32_t owner = is_alone ? probe : nodes_[probe].parent;
        const auto found = group_of_node_.find(owner);
        if (found != group_of_node_.end()) return found->second;
        ProbeGroup group;
        group.name = nodes_.path_of(owner);
        if (auto status = detail::check_group_name(group.name); !status) return status.error();
        group_of_node_.emplace(owner, groups_.size());
        groups_.push_back(std::move(group));
        return groups_.size() - 1;
    }

    Status add_probe(uint32_t index, bool is_top_level) {
        const GodotNode& node = nodes_[index];
        if (!node.is_placed) {
            if (left_out_++ == 0) first_left_out_ = nodes_.path_of(index);
            return Ok{};
        }
        if (node.assumed_root != GodotNode::kNoParent) {
            if (assumed_++ == 0) first_assumed_ = nodes_.path_of(node.assumed_root);
        }
        const glm::dvec3 position(node.world_from_node[3]);
        if (!is_finite(position)) {
            return Error{ErrorCode::Corrupt, "transform", "",
                         str_cat("its position in the world is not finite (", position.x, ", ",
                                 position.y, ", ", position.z, ")")};
        }
        const auto group = group_of(index, is_top_level || node.parent == GodotNode::kNoParent);
        if (!group) return group.error();
        groups_[*group].positions.push_back(position);
        return Ok{};
    }

    [[nodiscard]] std::string instances_text() const {
        std::string files;
        for (const std::string& file : files_) {
            if (&file == &*files_.begin()) files += " (";
            files += (&file == &*files_.begin() ? "" : ", ") + detail::quoted_text(file);
        }
        if (!files.empty()) files += ")";
        return str_cat(instance_count_,
                       instance_count_ == 1
                           ? " instanced scene is not followed, and its probes are not read"
                           : " instanced scenes are not followed, and their probes are not read",
                       files, "; in Godot, Make Local puts their nodes into this file");
    }

    [[nodiscard]] std::vector<std::string> warnings(const std::string& path) const {
        std::vector<std::string> result;
        if (instance_count_ > 0) result.push_back(str_cat(path, ": ", instances_text()));
        if (left_out_ > 0)
            result.push_back(str_cat(path, ": ", left_out_,
                                     left_out_ == 1 ? " probe is" : " probes are",
                                     " left out, because their parents belong to instanced scenes "
                                     "and have no transform in this file (the first: ",
                                     detail::quoted_text(first_left_out_), ")"));
        if (assumed_ > 0)
            result.push_back(
                str_cat(path, ": instance ", detail::quoted_text(first_assumed_),
                        " has no transform in this file: ", assumed_,
                        assumed_ == 1 ? " probe below it is" : " probes below such instances are",
                        " placed as if the root of its scene had none either"));
        return result;
    }

    static constexpr size_t kMostFiles = 3;

    std::optional<GodotNodeText> open_;
    detail::GodotNodes nodes_;
    std::vector<ProbeGroup> groups_;
    std::unordered_map<uint32_t, size_t> group_of_node_;
    std::unordered_map<std::string, std::string> file_of_id_;
    std::set<std::string> files_;
    size_t instance_count_ = 0;
    size_t left_out_ = 0;
    size_t assumed_ = 0;
    std::string first_left_out_;
    std::string first_assumed_;
};

}  // namespace

Result<ImportedGroups> read_godot_groups(const std::string& path) {
    const auto file = detail::TextFile::open(path);
    if (!file) return file.error();
    const auto located = [&](const Error& error) {
        Error result = error;
        result.message = error.message.prefixed(path + ":");
        return result;
    };
    detail::GodotText text(file->text());
    GodotScene scene;
    bool is_first = true;
    while (true) {
        const auto entry = text.next();
        if (!entry) return located(entry.error());
        if (!*entry) break;
        const Status status =
            std::exchange(is_first, false) ? check_format(**entry) : scene.add(**entry);
        if (!status) return located(status.error());
    }
    if (auto status = scene.finish_node(); !status) return located(status.error());
    ImportedGroups imported = scene.take(path);
    if (!imported.groups.empty()) return imported;
    return Error{
        ErrorCode::NotFound, "groups", path,
        str_cat(path, ": has no LightmapProbe nodes that can be placed", scene.why_none())};
}

}  // namespace tetralight
