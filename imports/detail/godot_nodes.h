// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// What a scene says of a node: its heading and the properties that place it.
struct GodotNodeText {
    std::string name;
    /// Empty for a node of a scene that is instanced.
    std::string type;
    /// The path from the root; "." is the root. None for the root itself.
    std::optional<std::string> parent;
    /// True if the node is the root of another scene.
    bool is_instance = false;
    std::optional<glm::dmat4> parent_from_node;
    /// The transform is in world space.
    bool is_top_level = false;
    size_t line = 0;
};

/// A node of a scene in world space.
struct GodotNode {
    static constexpr uint32_t kNoParent = 0xffffffff;

    uint32_t parent = kNoParent;
    glm::dmat4 world_from_node{1.0};
    /// False if the file does not say where the node is: it, or a parent, is a node of another
    /// scene without a transform here.
    bool is_placed = true;
    /// The node or a parent of it is the root of another scene: it may have nodes that are not in
    /// this file.
    bool is_foreign = false;
    /// The nearest root of another scene, of this node or its parents, that has no transform here
    /// and stands as if that root were at the origin.
    uint32_t assumed_root = kNoParent;
};

/// The tree of a scene's nodes.
class GodotNodes {
  public:
    /// Adds a node and returns its index. Parents come before their children, as Godot writes
    /// them. Returns corrupt for a second root, a second node of a path, and a parent that is not
    /// in the file.
    [[nodiscard]] Result<uint32_t> add(const GodotNodeText& text);

    [[nodiscard]] const GodotNode& operator[](uint32_t index) const { return nodes_[index]; }

    /// The names from the root to the node: "Level/Hall". At most a little more than
    /// `kLongestGroupName` bytes, which are enough to see that the path is too long.
    [[nodiscard]] std::string path_of(uint32_t index) const;

  private:
    struct Key {
        uint32_t parent;
        std::string_view name;

        bool operator==(const Key&) const = default;
    };

    struct KeyHash {
        size_t operator()(const Key& key) const {
            return std::hash<std::string_view>()(key.name) ^
                   (size_t{key.parent} + 1) * 0x9e3779b97f4a7c15u;
        }
    };

    [[nodiscard]] Result<uint32_t> add_child(uint32_t parent, std::string_view name);
    [[nodiscard]] Result<uint32_t> find_parent(std::string_view path);

    std::vector<GodotNode> nodes_;
    /// The name of each node; the map below has views of them.
    std::deque<std::string> names_;
    std::unordered_map<Key, uint32_t, KeyHash> node_of_key_;
};

}  // namespace tetralight::detail
