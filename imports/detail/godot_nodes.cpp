// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/godot_nodes.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/text_file.h>

namespace tetralight::detail {
namespace {

/// Types of nodes that are not a Node3D and may have children: children do not inherit the
/// transform of what is above them.
constexpr std::string_view kNotSpatial[] = {"AnimationPlayer",
                                            "CanvasGroup",
                                            "CanvasLayer",
                                            "Control",
                                            "HTTPRequest",
                                            "MarginContainer",
                                            "Node",
                                            "Node2D",
                                            "Panel",
                                            "PanelContainer",
                                            "SubViewport",
                                            "Timer",
                                            "SubViewportContainer",
                                            "VBoxContainer",
                                            "Window"};

bool is_spatial(const std::string& type) {
    return std::ranges::find(kNotSpatial, type) == std::end(kNotSpatial);
}

}  // namespace

Result<uint32_t> GodotNodes::add_child(uint32_t parent, std::string_view name) {
    const auto index = static_cast<uint32_t>(nodes_.size());
    const std::string& kept = names_.emplace_back(name);
    if (!node_of_key_.emplace(Key{parent, kept}, index).second) {
        names_.pop_back();
        return Error{ErrorCode::Corrupt, "name", std::string(name.substr(0, 60)),
                     "another node has the same name and parent"};
    }
    GodotNode& node = nodes_.emplace_back();
    node.parent = parent;
    if (parent == GodotNode::kNoParent) return index;
    node.world_from_node = nodes_[parent].world_from_node;
    node.is_placed = nodes_[parent].is_placed;
    node.is_foreign = nodes_[parent].is_foreign;
    node.assumed_root = nodes_[parent].assumed_root;
    return index;
}

Result<uint32_t> GodotNodes::find_parent(std::string_view path) {
    const auto missing = [&] {
        return Error{ErrorCode::Corrupt, "parent", std::string(path.substr(0, 60)),
                     str_cat("its parent ", quoted_text(path), " is not before it in the file")};
    };
    if (nodes_.empty()) return missing();
    uint32_t node = 0;
    if (path == ".") return node;
    for (std::string_view rest = path; !rest.empty();) {
        const std::string_view name = rest.substr(0, rest.find('/'));
        rest.remove_prefix(std::min(rest.size(), name.size() + 1));
        const auto found = node_of_key_.find(Key{node, name});
        if (found != node_of_key_.end()) {
            node = found->second;
            continue;
        }
        if (!nodes_[node].is_foreign) return missing();
        // A node of a scene that is not read.
        const auto added = add_child(node, name);
        if (!added) return added;
        node = *added;
        nodes_[node].is_placed = false;
    }
    return node;
}

Result<uint32_t> GodotNodes::add(const GodotNodeText& text) {
    const bool is_root = !text.parent;
    if (is_root && !nodes_.empty())
        return Error{ErrorCode::Corrupt, "parent", "", "has no parent, as the root before it"};
    Result<uint32_t> parent = is_root ? uint32_t{GodotNode::kNoParent} : find_parent(*text.parent);
    if (!parent) return parent;
    const auto index = add_child(*parent, text.name);
    if (!index) return index;
    GodotNode& node = nodes_[*index];
    const bool is_of_other_scene = text.type.empty() && !text.is_instance;
    if (text.is_top_level || !is_spatial(text.type)) {
        // Children of a node that is not spatial are placed in the world.
        node.world_from_node = glm::dmat4(1.0);
        node.is_placed = true;
        node.assumed_root = GodotNode::kNoParent;
    }
    if (text.parent_from_node) {
        node.world_from_node = node.world_from_node * *text.parent_from_node;
    } else if (text.is_instance) {
        node.assumed_root = *index;
    } else if (is_of_other_scene) {
        node.is_placed = false;
    }
    node.is_foreign = node.is_foreign || text.is_instance;
    return index;
}

std::string GodotNodes::path_of(uint32_t index) const {
    std::vector<std::string_view> names;
    size_t length = 0;
    for (uint32_t i = index; i != GodotNode::kNoParent && length <= kLongestGroupName;
         i = nodes_[i].parent) {
        names.emplace_back(names_[i]);
        length += names_[i].size() + 1;
    }
    std::string path;
    for (auto name = names.rbegin(); name != names.rend(); ++name)
        path += (path.empty() ? "" : "/") + std::string(name->substr(0, kLongestGroupName + 1));
    return path;
}

}  // namespace tetralight::detail
