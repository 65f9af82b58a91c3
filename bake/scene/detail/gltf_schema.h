// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace tetralight::detail {

/// The type that the value of a property must have.
enum class GltfKind {
    Index,         ///< index of an element of `target`
    IndexList,     ///< array of indices
    IndexLists,    ///< array of arrays of `length` indices
    IndexMap,      ///< object whose values are indices
    IndexMapList,  ///< array of such objects
    Size,          ///< integer 0 .. 2^32 - 1
    SizeMap,       ///< object whose values are such integers
    Integer,       ///< -2^31 .. 2^31 - 1
    Number,
    Numbers,      ///< array of `length` numbers; of any number of them if it is 0
    NumbersList,  ///< array of arrays of `length` numbers
    Boolean,
    BooleanOrBit,  ///< or 0 or 1, as exporters write it that have no boolean properties
    String,
    Object,
    ObjectOrBoolean,  ///< or 0 or 1
    Part,             ///< object that obeys the rules of the part `target`
    Parts,            ///< array of them
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

/// Rules for objects inside of elements, of which an element may have several.
struct GltfPart {
    const char* name;
    /// What messages call one of a list.
    const char* element;
    std::span<const GltfRule> rules;
};

/// The part of this name, which a rule names as its target.
[[nodiscard]] const GltfPart& gltf_part(std::string_view name);

}  // namespace tetralight::detail
