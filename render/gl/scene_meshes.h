// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <type_traits>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/render/gl/gl.h>
#include <tetralight/render/scene_light.h>

namespace tetralight {

/// The material of one mesh as shaders read it (std430).
struct GlMaterial {
    glm::vec4 base_color{1.0f};
    glm::vec4 emission{0.0f};  ///< w: weight of an unlit material's colour
    /// Metallic, roughness, alpha cutoff, scale of the normal map.
    glm::vec4 factors{1.0f, 1.0f, 0.5f, 1.0f};
    /// xyz: texture coordinate sets of base colour, metallic-roughness and emission, counted from
    /// 1; 0 = no texture. w: 1 = unlit.
    glm::uvec4 textures{0};
    /// Two rows of the transform of each texture, the normal map last.
    glm::vec4 uv_rows[8]{};
    /// x: its `AlphaMode`. y: the texture coordinate set of the normal map, counted from 1; 0 =
    /// none.
    glm::uvec4 alpha_mode{0};
};

static_assert(sizeof(GlMaterial) == 208 && std::is_trivially_copyable_v<GlMaterial>);

/// The range of a mesh in the vertex and index buffers.
struct GlMesh {
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    int32_t first_vertex = 0;
    AlphaMode alpha_mode = AlphaMode::Opaque;
    bool is_double_sided = false;
    /// Textures of base colour, metallic-roughness and emission; 0 = none.
    std::array<GLuint, 3> textures{};
    GLuint normal_map = 0;  ///< 0 = none
};

/// The meshes of a scene, their materials and textures, and spheres of each subdivision.
class SceneMeshes {
  public:
    static constexpr uint32_t kSphereCount = 5;

    /// Makes an unwrapped copy of each mesh for the packings that instances with a lightmap use.
    SceneMeshes(const Scene& scene, const SceneLight& light);

    /// Binds vertices, indices and materials for draw calls.
    void bind(GLuint material_binding) const;

    /// The meshes of the scene, then unwrapped ones, then the spheres, coarse to fine. Each has a
    /// material of the same index.
    [[nodiscard]] const GlMesh& mesh(size_t index) const { return meshes_[index]; }

    /// Index of the mesh that an instance of the scene is drawn with.
    [[nodiscard]] uint32_t mesh_of(uint32_t instance) const { return instance_meshes_[instance]; }

    /// Index of a sphere's mesh and material.
    [[nodiscard]] uint32_t sphere(uint32_t subdivisions) const {
        return static_cast<uint32_t>(meshes_.size()) - kSphereCount + subdivisions;
    }

  private:
    GLuint texture(const Scene& scene, const TextureUse& use, GLenum format);
    GLuint normal_map(const Scene& scene, const TextureUse& use);

    std::vector<GlMesh> meshes_;
    std::vector<uint32_t> instance_meshes_;
    /// For each texture of the scene: [0] decoded from sRGB, [1] as linear data.
    std::array<std::vector<GlTexture>, 2> textures_;
    std::vector<GlTexture> normal_maps_;
    GlVertexArray arrays_;
    GlBuffer vertices_, indices_, materials_;
};

}  // namespace tetralight
