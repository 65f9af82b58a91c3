// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/scene_meshes.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include <tetralight/bake/scene/mapped_normal.h>
#include <tetralight/render/gl/sphere_mesh.h>

namespace tetralight {
namespace {

struct Vertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< 0 = use the normal of the triangle
    glm::vec2 uvs[2]{};
    glm::vec4 color{1.0f};
    glm::vec2 lightmap_uv{0.0f};
    glm::vec4 tangent{0.0f};  ///< 0 = tangent space comes from the UVs of the normal map
};

GLint gl_wrap(TextureWrap wrap) {
    switch (wrap) {
        case TextureWrap::Repeat:
            return GL_REPEAT;
        case TextureWrap::MirroredRepeat:
            return GL_MIRRORED_REPEAT;
        case TextureWrap::ClampToEdge:
            break;
    }
    return GL_CLAMP_TO_EDGE;
}

GlTexture make_texture(const Texture& texture, GLenum format) {
    const auto width = static_cast<GLsizei>(texture.image.width);
    const auto height = static_cast<GLsizei>(texture.image.height);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    const auto levels =
        static_cast<GLsizei>(std::bit_width(std::max(texture.image.width, texture.image.height)));
    glTextureStorage2D(name, levels, format, width, height);
    glTextureSubImage2D(name, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                        texture.image.pixels.data());
    glGenerateTextureMipmap(name);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, gl_wrap(texture.wrap_u));
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, gl_wrap(texture.wrap_v));
    return GlTexture(name);
}

/// The texture coordinate set of a texture, counted from 1; 0 if the mesh lacks it.
uint32_t uv_set(const TextureUse& use, const Mesh& mesh) {
    return use.texture == kNoIndex || mesh.uvs[use.uv_set].empty() ? 0 : 1 + use.uv_set;
}

GlMaterial make_material(const Material& material, const Mesh& mesh, float emission_weight) {
    GlMaterial result;
    result.base_color = material.base_color;
    result.emission = glm::vec4(material.emission * emission_weight, emission_weight);
    result.factors = {material.metallic, material.roughness, material.alpha_cutoff,
                      material.normal_scale};
    const TextureUse* uses[] = {&material.base_color_texture, &material.metallic_roughness_texture,
                                &material.emission_texture, &material.normal_texture};
    for (int i = 0; i < 4; ++i) {
        if (i < 3) result.textures[i] = uv_set(*uses[i], mesh);
        const glm::mat3& m = uses[i]->image_from_mesh;
        result.uv_rows[2 * i] = {m[0][0], m[1][0], m[2][0], 0.0f};
        result.uv_rows[2 * i + 1] = {m[0][1], m[1][1], m[2][1], 0.0f};
    }
    result.textures[3] = material.is_unlit ? 1 : 0;
    result.alpha_mode.x = static_cast<uint32_t>(material.alpha_mode);
    result.alpha_mode.y = uv_set(material.normal_texture, mesh);
    return result;
}

template <class Value>
std::vector<Value> one_a_corner(const std::vector<Value>& values,
                                const std::vector<uint32_t>& indices) {
    std::vector<Value> result;
    if (values.empty()) return result;
    for (const uint32_t index : indices) result.push_back(values[index]);
    return result;
}

/// The same mesh with three vertices of its own for each triangle, which can have unwrapped UVs.
Mesh with_split_vertices(const Mesh& mesh) {
    Mesh result;
    result.material = mesh.material;
    result.positions = one_a_corner(mesh.positions, mesh.indices);
    result.normals = one_a_corner(mesh.normals, mesh.indices);
    for (size_t set = 0; set < std::size(mesh.uvs); ++set)
        result.uvs[set] = one_a_corner(mesh.uvs[set], mesh.indices);
    result.colors = one_a_corner(mesh.colors, mesh.indices);
    result.tangents = one_a_corner(mesh.tangents, mesh.indices);
    result.indices.resize(mesh.indices.size());
    std::iota(result.indices.begin(), result.indices.end(), 0u);
    return result;
}

/// The unwrapped UVs of a packing, one a corner.
std::span<const glm::vec2> corner_uvs(const LightmapsView& lightmaps, uint32_t packing) {
    const LightmapMesh& mesh = lightmaps.meshes[packing];
    return lightmaps.corner_uvs.subspan(mesh.first_corner, 3 * size_t{mesh.triangle_count});
}

/// Which tangents vertices get.
enum class TangentUse : bool { None, OfVertices };

TangentUse tangent_use(const Scene& scene, const Mesh& mesh) {
    const bool is_used = has_normal_map(scene, mesh) && uses_tangents(scene, mesh);
    return is_used ? TangentUse::OfVertices : TangentUse::None;
}

void append_vertices(const Mesh& mesh, TangentUse tangents, std::vector<Vertex>& vertices) {
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        Vertex& vertex = vertices.emplace_back();
        vertex.position = mesh.positions[i];
        if (!mesh.normals.empty()) vertex.normal = mesh.normals[i];
        for (int set = 0; set < 2; ++set) {
            if (!mesh.uvs[set].empty()) vertex.uvs[set] = mesh.uvs[set][i];
        }
        if (!mesh.colors.empty()) vertex.color = mesh.colors[i];
        if (tangents == TangentUse::OfVertices) vertex.tangent = mesh.tangents[i];
    }
}

GlVertexArray make_arrays(const GlBuffer& vertices, const GlBuffer& indices) {
    struct Attribute {
        GLint size;
        GLuint offset;
    };

    static constexpr Attribute kAttributes[] = {
        {3, offsetof(Vertex, position)},    {3, offsetof(Vertex, normal)},
        {4, offsetof(Vertex, uvs)},         {4, offsetof(Vertex, color)},
        {2, offsetof(Vertex, lightmap_uv)}, {4, offsetof(Vertex, tangent)}};
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    glVertexArrayVertexBuffer(name, 0, vertices.name(), 0, sizeof(Vertex));
    glVertexArrayElementBuffer(name, indices.name());
    for (GLuint i = 0; i < std::size(kAttributes); ++i) {
        glEnableVertexArrayAttrib(name, i);
        glVertexArrayAttribFormat(name, i, kAttributes[i].size, GL_FLOAT, GL_FALSE,
                                  kAttributes[i].offset);
        glVertexArrayAttribBinding(name, i, 0);
    }
    return GlVertexArray(name);
}

}  // namespace

GLuint SceneMeshes::texture(const Scene& scene, const TextureUse& use, GLenum format) {
    if (use.texture == kNoIndex) return 0;
    auto& textures = textures_[format == GL_SRGB8_ALPHA8 ? 0 : 1];
    textures.resize(scene.textures.size());
    GlTexture& texture = textures[use.texture];
    if (texture.name() == 0) texture = make_texture(scene.textures[use.texture], format);
    return texture.name();
}

GLuint SceneMeshes::normal_map(const Scene& scene, const TextureUse& use) {
    if (use.texture == kNoIndex) return 0;
    normal_maps_.resize(scene.normal_maps.size());
    GlTexture& texture = normal_maps_[use.texture];
    if (texture.name() == 0) texture = make_texture(scene.normal_maps[use.texture], GL_RGBA8);
    return texture.name();
}

SceneMeshes::SceneMeshes(const Scene& scene, const SceneLight& light) {
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<GlMaterial> materials;
    const auto add = [&](const Mesh& mesh, const GlMaterial& material,
                         TangentUse tangents = TangentUse::None) -> GlMesh& {
        GlMesh& added = meshes_.emplace_back();
        added.first_index = static_cast<uint32_t>(indices.size());
        added.index_count = static_cast<uint32_t>(mesh.indices.size());
        added.first_vertex = static_cast<int32_t>(vertices.size());
        append_vertices(mesh, tangents, vertices);
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
        materials.push_back(material);
        return added;
    };
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[mesh.material];
        const float weight = light.emission_weights[mesh.material];
        GlMesh& added = add(mesh, make_material(material, mesh, weight), tangent_use(scene, mesh));
        added.alpha_mode = material.alpha_mode;
        added.is_double_sided = material.is_double_sided;
        added.textures = {texture(scene, material.base_color_texture, GL_SRGB8_ALPHA8),
                          texture(scene, material.metallic_roughness_texture, GL_RGBA8),
                          texture(scene, material.emission_texture, GL_SRGB8_ALPHA8)};
        added.normal_map = normal_map(scene, material.normal_texture);
    }
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> unwrapped;  // by mesh and packing
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const uint32_t mesh = scene.instances[i].mesh;
        instance_meshes_.push_back(mesh);
        if (light.instances[i].use != ProbeUse::Lightmap) continue;
        const uint32_t packing = light.lightmaps.rectangles[i].mesh;
        const auto next = static_cast<uint32_t>(meshes_.size());
        const auto [known, is_new] = unwrapped.try_emplace({mesh, packing}, next);
        instance_meshes_.back() = known->second;
        if (!is_new) continue;
        const GlMesh original = meshes_[mesh];
        GlMesh& added = add(with_split_vertices(scene.meshes[mesh]), materials[mesh],
                            tangent_use(scene, scene.meshes[mesh]));
        added.alpha_mode = original.alpha_mode;
        added.is_double_sided = original.is_double_sided;
        added.textures = original.textures;
        added.normal_map = original.normal_map;
        const std::span<const glm::vec2> uvs = corner_uvs(light.lightmaps, packing);
        for (size_t corner = 0; corner < uvs.size(); ++corner)
            vertices[added.first_vertex + corner].lightmap_uv = uvs[corner];
    }
    for (uint32_t i = 0; i < kSphereCount; ++i) add(make_sphere_mesh(i), {});
    vertices_ = make_gl_buffer(vertices);
    indices_ = make_gl_buffer(indices);
    materials_ = make_gl_buffer(materials);
    arrays_ = make_arrays(vertices_, indices_);
}

void SceneMeshes::bind(GLuint material_binding) const {
    glBindVertexArray(arrays_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, material_binding, materials_.name());
}

}  // namespace tetralight
