// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>  // tiny_gltf.h needs it and leaves it out with TINYGLTF_NO_FS
#include <string>

#include <tetralight/bake/scene/detail/gltf_document.h>

// The only header that includes tinygltf, for the files that use it. tinygltf parses JSON and
// decodes base64; our own code reads files, decodes images and checks everything.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

namespace tetralight::detail {

/// The contents of a model as plain values. Precondition: its JSON passed check_gltf_json().
[[nodiscard]] GltfDocument document_from(tinygltf::Model model, const std::string& path);

}  // namespace tetralight::detail
