// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/sound_scene.h"

#include "tests/fuzz/seed_files.h"

namespace tetralight::fuzz {
namespace {

using Json = nlohmann::json;

void add_images(GltfBuilder& gltf) {
    for (const auto& [file, type] :
         {std::pair("palette_interlaced.png", "image/png"),
          std::pair("color_420.jpg", "image/jpeg"), std::pair("lossless.webp", "image/webp")}) {
        const std::string bytes = read_text(std::string(TETRALIGHT_FUZZ_SEEDS "/images/") + file);
        const size_t view = gltf.add_view(std::vector<char>(bytes.begin(), bytes.end()));
        gltf.add("images", {{"name", file}, {"bufferView", view}, {"mimeType", type}});
    }
    // The smallest PNG: one grey pixel.
    gltf.add("images",
             {{"uri",
               "data:image/png;base64,"
               "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytg"
               "AAAABJRU5ErkJggg=="}});
    gltf.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
    gltf.add("textures", {{"source", 0}, {"sampler", 0}, {"name", "palette"}});
    gltf.add("textures", {{"source", 1}});
    gltf.add("textures", {{"extensions", {{"EXT_texture_webp", {{"source", 2}}}}}});
    gltf.add("textures", {{"source", 3}, {"sampler", 0}});
}

void add_materials(GltfBuilder& gltf) {
    const Json transform = {
        {"KHR_texture_transform",
         {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", 0.5}, {"texCoord", 1}}}};
    gltf.add("materials", {{"name", "all"},
                           {"pbrMetallicRoughness",
                            {{"baseColorFactor", {0.5, 0.6, 0.7, 0.8}},
                             {"metallicFactor", 0.25},
                             {"roughnessFactor", 0.75},
                             {"baseColorTexture", {{"index", 0}, {"extensions", transform}}},
                             {"metallicRoughnessTexture", {{"index", 1}, {"texCoord", 1}}}}},
                           {"emissiveFactor", {1, 0.5, 0}},
                           {"emissiveTexture", {{"index", 2}}},
                           {"normalTexture", {{"index", 3}, {"scale", 0.5}}},
                           {"extensions",
                            {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
                             {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}}}},
                           {"extras", {{"bake_emission", "baked"}}},
                           {"alphaMode", "MASK"},
                           {"alphaCutoff", 0.5},
                           {"doubleSided", true}});
    gltf.add("materials",
             {{"extensions", {{"KHR_materials_unlit", Json::object()}}}, {"alphaMode", "BLEND"}});
    gltf.add("materials", {{"extensions",
                            {{"KHR_materials_pbrSpecularGlossiness",
                              {{"diffuseFactor", {1, 0.5, 0.25, 1}},
                               {"specularFactor", {0.1, 0.2, 0.3}},
                               {"glossinessFactor", 0.5},
                               {"diffuseTexture", {{"index", 1}}}}}}}});
}

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

/// Two indexed triangles with all attributes, and a morph target.
void add_square(GltfBuilder& gltf) {
    const size_t mesh = gltf.add_mesh(kSquare);
    const size_t indices =
        gltf.add_accessor(std::vector<uint16_t>{0, 1, 2, 2, 1, 3}, "SCALAR", 5123);
    const size_t normals = gltf.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const size_t tangents =
        gltf.add_floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1, 1, 0, 0, -1}, "VEC4");
    const size_t uvs = gltf.add_floats({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
    const size_t bytes =
        gltf.add_accessor(std::vector<uint8_t>{0, 0, 255, 0, 0, 255, 255, 255}, "VEC2", 5121);
    gltf.json["accessors"][bytes]["normalized"] = true;
    const size_t colors = gltf.add_floats({1, 1, 1, 1, 0, 0, 1, 1, 0, 1, 0, 1}, "VEC3");
    const size_t joints = gltf.add_accessor(std::vector<uint8_t>(16, 0), "VEC4", 5121);
    const size_t weights =
        gltf.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4");
    Json& primitive = gltf.primitive(mesh);
    primitive["indices"] = indices;
    primitive["material"] = 0;
    Json& attributes = primitive["attributes"];
    attributes["NORMAL"] = normals;
    attributes["TANGENT"] = tangents;
    attributes["TEXCOORD_0"] = uvs;
    attributes["TEXCOORD_1"] = bytes;
    attributes["COLOR_0"] = colors;
    attributes["JOINTS_0"] = joints;
    attributes["WEIGHTS_0"] = weights;
    primitive["targets"] = Json::array({{{"POSITION", gltf.add_floats(kSquare, "VEC3")}}});
    gltf.json["meshes"][mesh]["weights"] = {0.5};
}

/// A strip, a fan and points, the strip with a sparse accessor without a buffer view of its own.
void add_other_modes(GltfBuilder& gltf) {
    for (const int mode : {5, 6, 0}) {
        const size_t mesh = gltf.add_mesh(kSquare);
        gltf.primitive(mesh)["mode"] = mode;
        gltf.primitive(mesh)["material"] = mode == 5 ? 1 : 2;
    }
    const size_t places = gltf.add_view(std::vector<uint16_t>{1, 2});
    const size_t values = gltf.add_view(std::vector<float>{1, 0, 0, 1, 1, 0});
    const size_t sparse =
        gltf.add("accessors", {{"componentType", 5126},
                               {"count", 4},
                               {"type", "VEC3"},
                               {"sparse",
                                {{"count", 2},
                                 {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", values}}}}}});
    gltf.primitive(1)["attributes"]["POSITION"] = sparse;
}

void add_lights(GltfBuilder& gltf) {
    gltf.add_light({{"type", "directional"}, {"intensity", 3}, {"extras", {{"angle", 0.5}}}});
    gltf.add_light(
        {{"type", "point"}, {"range", 9}, {"extras", {{"radius", 0.1}, {"mode", "mixed"}}}});
    gltf.add_light({{"type", "spot"},
                    {"color", {1, 0.5, 0.25}},
                    {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}});
    for (size_t light = 0; light < 3; ++light) {
        gltf.add_root(
            {{"translation", {0, 5, light}}, {"extensions", GltfBuilder::light_extension(light)}});
    }
}

/// Area lights, and a sky of an image of one pixel.
void add_lights_of_extensions(GltfBuilder& gltf) {
    gltf.json["extensions"]["EXT_lights_area"]["lights"] = {
        {{"type", "rect"}, {"intensity", 200}, {"size", 2}, {"rect", {{"aspect", 1.5}}}},
        {{"type", "disk"}, {"intensity", 900}, {"color", {1, 0.5, 0.25}}}};
    for (const size_t light : {0, 1})
        gltf.add_root({{"extensions", {{"EXT_lights_area", {{"light", light}}}}}});
    Json coefficients = Json::array();
    for (int i = 0; i < 9; ++i) coefficients.push_back({10 - i, 1, 0.5});
    const Json light = {{"rotation", {0.6, 0, 0, 0.8}},
                        {"intensity", 2},
                        {"irradianceCoefficients", coefficients},
                        {"specularImageSize", 1},
                        {"specularImages", Json::array({{3, 3, 3, 3, 3, 3}})}};
    gltf.json["extensions"]["EXT_lights_image_based"]["lights"].push_back(light);
    gltf.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
}

void add_nodes(GltfBuilder& gltf) {
    gltf.add_root(
        {{"name", "group"},
         {"mesh", 3},
         {"extras",
          {{"light_probe_group", true}, {"dering", true}, {"rendering_layers", {0, 3}}}}});
    const size_t child = gltf.add("nodes", {{"mesh", 1}, {"scale", {1, 2, -1}}});
    gltf.add_root({{"name", "square"},
                   {"mesh", 0},
                   {"children", {child}},
                   {"rotation", {0, 0.6, 0, 0.8}},
                   {"extras", {{"contribute_gi", false}, {"lightmap_scale", 2}}}});
    gltf.add_root({{"mesh", 2}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 2, 1, 1}}});
    gltf.add_root({{"extras", {{"portal", {1.5, 2}}}}});
    gltf.add_root({{"extras", {{"reflection_probe", {{"size", {4, 3, 6}}, {"importance", 2}}}}}});
    gltf.add_root(
        {{"extras",
          {{"probe_adjustment", {{"shape", "box"}, {"size", {1, 2, 3}}, {"validity", 1}}}}}});
    const size_t places = gltf.add_floats({0, 0, 0, 5, 0, 0}, "VEC3");
    const size_t turns = gltf.add_floats({0, 0, 0, 1, 0, 1, 0, 0}, "VEC4");
    gltf.add_root({{"mesh", 2},
                   {"extensions",
                    {{"EXT_mesh_gpu_instancing",
                      {{"attributes", {{"TRANSLATION", places}, {"ROTATION", turns}}}}}}}});
    gltf.add("cameras",
             {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
    gltf.add("cameras", {{"type", "orthographic"}, {"orthographic", {{"ymag", 2}, {"xmag", 2}}}});
    gltf.add_root({{"camera", 0}});
    gltf.add_root({{"camera", 1}});
}

/// Moves a node of the name "square" and its joint for two seconds.
void add_animation(GltfBuilder& gltf) {
    const size_t joint = gltf.add_root({{"name", "joint"}});
    const size_t skinned = gltf.add_root({{"mesh", 0}, {"skin", 0}, {"weights", {0.25}}});
    const size_t inverse =
        gltf.add_floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4");
    gltf.add("skins", {{"joints", {joint}}, {"inverseBindMatrices", inverse}});
    const size_t times = gltf.add_floats({0, 1, 2}, "SCALAR");
    const size_t places = gltf.add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0}, "VEC3");
    const size_t turns = gltf.add_floats({0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 1}, "VEC4");
    const size_t weights = gltf.add_floats({0, 0.5, 1, 0, 0.5, 1, 0, 0.5, 1}, "SCALAR");
    const auto channel = [](size_t sampler, size_t node, const char* path) {
        return Json{{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
    };
    gltf.add("animations",
             {{"name", "move"},
              {"samplers",
               {{{"input", times}, {"output", places}},
                {{"input", times}, {"output", turns}, {"interpolation", "STEP"}},
                {{"input", times}, {"output", weights}, {"interpolation", "CUBICSPLINE"}}}},
              {"channels",
               {channel(0, joint, "translation"), channel(1, joint, "rotation"),
                channel(2, skinned, "weights")}}});
}

}  // namespace

GltfBuilder sound_scene() {
    GltfBuilder gltf;
    gltf.json["asset"]["generator"] = "fuzz";
    add_images(gltf);
    add_materials(gltf);
    add_square(gltf);
    add_other_modes(gltf);
    add_nodes(gltf);
    add_lights(gltf);
    add_lights_of_extensions(gltf);
    add_animation(gltf);
    gltf.json["scenes"][1]["extras"]["sky"]["radiance"] = {0.1, 0.2, 0.3};
    return gltf;
}

}  // namespace tetralight::fuzz
