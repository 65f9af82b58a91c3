// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/error_text.h>
#include "tests/support/temp_folder.h"

namespace tetralight {

/// Makes small glTF files for tests: JSON that a test may change as it likes, and one buffer.
struct GltfBuilder {
    using Json = nlohmann::json;

    Json json = {{"asset", {{"version", "2.0"}}}};
    std::string binary;

    /// Appends an element to an array of the document; returns its index.
    size_t add(const char* array, Json element) {
        json[array].push_back(std::move(element));
        return json[array].size() - 1;
    }

    template <class T>
    size_t add_view(const std::vector<T>& values) {
        const size_t offset = binary.size();
        binary.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        const size_t length = binary.size() - offset;
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
    }

    /// Numbers in an element of this type: "VEC3" has 3, "MAT4" 16.
    static size_t component_count(const std::string& type) {
        if (type == "SCALAR") return 1;
        const auto size = static_cast<size_t>(type.back() - '0');
        return type.starts_with("MAT") ? size * size : size;
    }

    template <class T>
    size_t add_accessor(const std::vector<T>& values, const char* type, int component_type) {
        const size_t width = component_count(type);
        const size_t view = add_view(values);
        return add("accessors", {{"bufferView", view},
                                 {"componentType", component_type},
                                 {"count", values.size() / width},
                                 {"type", type}});
    }

    size_t add_floats(const std::vector<float>& values, const char* type) {
        return add_accessor(values, type, 5126);
    }

    /// A mesh of one primitive with these positions; the primitive can be changed afterwards.
    size_t add_mesh(const std::vector<float>& positions) {
        const size_t accessor = add_floats(positions, "VEC3");
        return add("meshes", {{"primitives", {{{"attributes", {{"POSITION", accessor}}}}}}});
    }

    size_t add_triangle() { return add_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}); }

    Json& primitive(size_t mesh) { return json["meshes"][mesh]["primitives"][0]; }

    /// Adds a node; roots stand in the one scene.
    size_t add_root(Json node) {
        const size_t index = add("nodes", std::move(node));
        json["scene"] = 0;
        json["scenes"][0]["nodes"].push_back(index);
        return index;
    }

    size_t add_light(Json light) {
        Json& lights = json["extensions"]["KHR_lights_punctual"]["lights"];
        lights.push_back(std::move(light));
        return lights.size() - 1;
    }

    /// A node's reference to a light.
    static Json light_extension(size_t light) {
        return {{"KHR_lights_punctual", {{"light", light}}}};
    }

    [[nodiscard]] std::string glb() const {
        Json document = json;
        if (!binary.empty() && !document.contains("buffers")) {
            document["buffers"] = {{{"byteLength", binary.size()}}};
        }
        std::string text = document.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string chunks = chunk(0x4e4f534a, text);
        if (!binary.empty()) chunks += chunk(0x004e4942, binary);
        return "glTF" + u32(2) + u32(chunks.size() + 12) + chunks;
    }

    [[nodiscard]] Result<Scene> read(const SceneReading& reading = {}) const {
        const TempFolder folder;
        return read_gltf(folder.write("scene.glb", glb()), reading);
    }

    /// Message of the error that reading has to give, from behind the folder's name.
    [[nodiscard]] std::string error(const SceneReading& reading = {}) const {
        const auto scene = read(reading);
        if (scene) return "(no error)";
        const std::string& message = error_text(scene.error());
        return message.substr(std::min(message.find("scene.glb"), message.size()));
    }

    static std::string u32(size_t value) {
        const auto bits = static_cast<uint32_t>(value);
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &bits, 4);
        return bytes;
    }

    static std::string chunk(uint32_t type, const std::string& bytes) {
        return u32(bytes.size()) + u32(type) + bytes;
    }
};

}  // namespace tetralight
