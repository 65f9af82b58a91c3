// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/file.h>
#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {

/// Makes scenes of triangles whose materials have images.
struct GltfImageScene : GltfBuilder {
    /// Adds a PNG and a texture that shows it; returns the index of the texture.
    size_t add_image(const Image8& image) {
        const TempFolder folder;
        const std::string path = folder.path("image.png");
        EXPECT_TRUE(write_png(path, image));
        const auto bytes = read_file(path);
        EXPECT_TRUE(bytes);
        const size_t index =
            add("images", {{"bufferView", add_view(*bytes)}, {"mimeType", "image/png"}});
        return add("textures", {{"source", index}});
    }

    /// Adds a triangle of a material; returns the index of its mesh.
    size_t add_painted(Json material) {
        const size_t mesh = add_triangle();
        primitive(mesh)["material"] = add("materials", std::move(material));
        add_root({{"mesh", mesh}});
        return mesh;
    }

    /// What is read; an empty scene, and a failed test, after an error.
    [[nodiscard]] Scene scene() const {
        auto scene = read();
        EXPECT_TRUE(scene) << (scene ? "" : error_text(scene.error()));
        return scene ? std::move(*scene) : Scene{};
    }
};

}  // namespace tetralight
