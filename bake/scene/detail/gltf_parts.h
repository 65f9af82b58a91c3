// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_raw_elements.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>

// A glTF file taken apart, so that some of it can change and the rest stays as it is.

namespace tetralight::detail {

using GltfJson = nlohmann::ordered_json;

/// A primitive: the index of its mesh, and its own.
using GltfPrimitivePlace = std::pair<uint32_t, uint32_t>;

/// The JSON of a file with the bytes of its buffer views. Files of images become buffer views;
/// data URIs stay.
class GltfParts {
  public:
    /// Reads the JSON of the document's file, and image files. Returns the errors of reading them.
    [[nodiscard]] static Result<GltfParts> open(const GltfDocument& document);

    /// Lets later additions take the places of accessors, and of their buffer views, that these
    /// primitives alone use: so the file does not keep what is replaced.
    void release_primitives(const std::set<GltfPrimitivePlace>& places);

    /// Index of a new buffer view. `members` may have a target or a stride.
    uint32_t add_view(std::vector<std::byte> bytes, GltfJson members = GltfJson::object());

    /// Index of a new accessor of `elements`, with the other members of `accessor`. Vertices start
    /// at multiples of four bytes. min and max follow from the elements if `accessor` has them.
    enum class View : uint8_t { Vertices, Indices };
    uint32_t add_accessor(GltfJson accessor, const RawElements& elements, View use);

    /// Appends an element to an array of the document; returns its index.
    uint32_t add(const char* array, GltfJson element);

    /// Lists an extension in `extensionsUsed`.
    void use_extension(const char* name);
    /// Removes an extension from `extensionsUsed` and `extensionsRequired` if no element has it.
    void drop_unused_extension(const char* name);

    /// The .glb file. Call it last.
    [[nodiscard]] Result<std::vector<std::byte>> glb();

    GltfJson json;
    /// The accessors as the file has them; those of `json` may have changed.
    GltfJson source_accessors = GltfJson::array();

  private:
    Status embed_images(const std::string& path);

    std::vector<std::vector<std::byte>> views_;
    std::vector<uint32_t> free_views_;      ///< the lowest index last
    std::vector<uint32_t> free_accessors_;  ///< the lowest index last
};

/// Makes the bytes of a .glb file of a document.
using WriteGlb = std::function<Result<std::vector<std::byte>>(const GltfDocument& document)>;

/// What `write` makes of the glTF file at a path, of whose scenes it is given the one that
/// `reading` chooses, in its pose. Errors begin with the path. Returns corrupt also
/// if `write` throws because JSON that `read_gltf` does not read is of a wrong type: animations,
/// for example.
[[nodiscard]] Result<std::vector<std::byte>> rewrite_gltf(const std::string& path,
                                                          const SceneReading& reading,
                                                          const WriteGlb& write);

}  // namespace tetralight::detail
