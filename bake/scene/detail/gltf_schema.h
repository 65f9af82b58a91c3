// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace tetralight::detail {

/// What a property's value has to be.
enum class GltfKind {
    Index,      ///< index of an element of `target`
    IndexList,  ///< array of such
    IndexMap,   ///< object whose values are such
    Size,       ///< integer 0 .. 2^32 - 1
    Number,
    Numbers,  ///< array of `length` numbers
    Boolean,
    String,
    Object,
    PrimitiveList,  ///< a mesh's primitives
};

enum class GltfNeed { Optional, Required };

/// A rule for one property of all elements of a section. `path` steps through objects by '/'.
struct GltfRule {
    const char* path;
    GltfKind kind;
    const char* target = "";
    size_t length = 0;
    GltfNeed need = GltfNeed::Optional;
};

/// An array of elements in a glTF document: where it lies and what messages call an element.
struct GltfSection {
    /// Name of the array; rules name their targets by it.
    const char* name;
    /// Where the array lies in the document.
    const char* path;
    const char* element;
    std::span<const GltfRule> rules;
};

/// All sections that read_gltf() uses.
[[nodiscard]] std::span<const GltfSection> gltf_sections();

/// Rules for the elements of a mesh's `primitives`.
[[nodiscard]] std::span<const GltfRule> gltf_primitive_rules();

}  // namespace tetralight::detail
