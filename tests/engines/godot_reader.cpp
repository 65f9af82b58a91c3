// SPDX-License-Identifier: Apache-2.0
#include "tests/engines/godot_reader.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <glm/geometric.hpp>

namespace tetralight::test {
namespace {

/// What follows the key, up to a line break.
std::string value_of(const std::string& resource, const std::string& key) {
    const std::string start = "\"" + key + "\": ";
    const size_t at = resource.find(start);
    if (at == std::string::npos) return {};
    const size_t from = at + start.size();
    return resource.substr(from, resource.find('\n', from) - from);
}

/// The arguments of `type(...)`; none if the value is of another type.
std::vector<double> numbers_of(const std::string& resource, const std::string& key,
                               const std::string& type) {
    std::vector<double> numbers;
    const std::string value = value_of(resource, key);
    if (value.substr(0, type.size() + 1) != type + "(") return numbers;
    const char* at = value.c_str() + type.size() + 1;
    while (*at != ')' && *at != '\0') {
        char* end = nullptr;
        numbers.push_back(std::strtod(at, &end));
        if (end == at) return {};
        at = end;
        while (*at == ',' || *at == ' ') ++at;
    }
    return numbers;
}

float plane_float(double number) {
    return std::bit_cast<float>(static_cast<int32_t>(number));
}

}  // namespace

GodotProbes::GodotProbes(const std::string& resource)
    : points(numbers_of(resource, "points", "PackedVector3Array")),
      sh(numbers_of(resource, "sh", "PackedColorArray")),
      tetrahedra(numbers_of(resource, "tetrahedra", "PackedInt32Array")),
      bsp(numbers_of(resource, "bsp", "PackedInt32Array")),
      interior(value_of(resource, "interior")),
      baked_exposure(value_of(resource, "baked_exposure")) {
    const auto bounds = numbers_of(resource, "bounds", "AABB");
    if (bounds.size() != 6) return;
    low = {bounds[0], bounds[1], bounds[2]};
    size = {bounds[3], bounds[4], bounds[5]};
}

int64_t GodotProbes::find(glm::vec3 position) const {
    double node = 0.0;
    for (size_t steps = 0; node >= 0.0; ++steps) {
        const size_t at = 6 * static_cast<size_t>(node);
        if (at + 6 > bsp.size() || steps > bsp.size()) return -1;
        const glm::vec3 normal(plane_float(bsp[at]), plane_float(bsp[at + 1]),
                               plane_float(bsp[at + 2]));
        const bool is_over = glm::dot(normal, position) > plane_float(bsp[at + 3]);
        node = bsp[at + (is_over ? 4 : 5)];
    }
    const auto tetrahedron = static_cast<int64_t>(-node) - 1;
    return 4 * static_cast<size_t>(tetrahedron) < tetrahedra.size() ? tetrahedron : -1;
}

std::array<double, 3> GodotProbes::light(glm::vec3 position, glm::vec3 normal) const {
    const auto first = static_cast<size_t>(4 * find(position));
    std::array<glm::dvec3, 4> corners;
    std::array<size_t, 4> probes{};
    for (size_t i = 0; i < 4; ++i) {
        probes[i] = static_cast<size_t>(tetrahedra.at(first + i));
        const double* p = points.data() + 3 * probes[i];
        corners[i] = {p[0], p[1], p[2]};
    }
    const glm::dvec3 n(normal);
    const std::array<double, 9> terms{0.886227,
                                      1.023327 * n.y,
                                      1.023327 * n.z,
                                      1.023327 * n.x,
                                      0.858086 * n.x * n.y,
                                      0.858086 * n.y * n.z,
                                      0.247708 * (3.0 * n.z * n.z - 1.0),
                                      0.858086 * n.x * n.z,
                                      0.429043 * (n.x * n.x - n.y * n.y)};
    const auto volume = [](const std::array<glm::dvec3, 4>& c) {
        return glm::dot(c[1] - c[0], glm::cross(c[2] - c[0], c[3] - c[0]));
    };
    std::array<double, 3> light{};
    for (size_t i = 0; i < 4; ++i) {
        auto part = corners;
        part[i] = glm::dvec3(position);
        const double weight = std::clamp(volume(part) / volume(corners), 0.0, 1.0);
        for (size_t k = 0; k < 36; ++k) {
            if (k % 4 < 3) light[k % 4] += weight * terms[k / 4] * sh.at(36 * probes[i] + k);
        }
    }
    return light;
}

}  // namespace tetralight::test
