// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace tetralight::detail {

/// The type that the value of a property must have.
enum class GltfKind {
    Index,      ///< index of an element of `target`
    IndexList,  ///< array of indices
    IndexMap,   ///< object whose values are indices
    Size,       ///< integer 0 .. 2^32 - 1
    Integer,    ///< -2^31 .. 2^31 - 1
    Number,
    Numbers,  ///< array of `length` numbers
    Boolean,
    String,
    Object,
    ObjectOrBoolean,
    PrimitiveList,    ///< a mesh's primitives
    RenderingLayers,  ///< array of integers 0 .. 31, not empty
};

enum class GltfNeed {
    Optional,
    Required,
    InObject,  ///< optional, in a value that need not be an object
};

/// A rule for one property of all elements of a section. `path` separates the keys of nested
/// objects by '/'.
struct GltfRule {
    const char* path;
    GltfKind kind;
    const char* target = "";
    size_t length = 0;
    GltfNeed need = GltfNeed::Optional;
};

/// An array of elements in a glTF document.
struct GltfSection {
    /// Name of the array; rules name their targets by it.
    const char* name;
    /// The keys that lead to the array, separated by '/'.
    const char* path;
    /// What messages call an element.
    const char* element;
    std::span<const GltfRule> rules;
};

/// All sections that read_gltf() uses.
[[nodiscard]] std::span<const GltfSection> gltf_sections();

/// A path of keys as errors write it: `extras/sky` becomes `extras.sky`.
[[nodiscard]] std::string member_path(std::string_view path);

/// Rules for the elements of a mesh's `primitives`.
[[nodiscard]] std::span<const GltfRule> gltf_primitive_rules();

}  // namespace tetralight::detail
