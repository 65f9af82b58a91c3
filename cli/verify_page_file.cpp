// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/verify_page_file.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/file.h>
#include <tetralight/cli/view_options.h>
#include <tetralight/render/draw_lines.h>
#include <tetralight/render/render_scene.h>
#include <tetralight/verify/verify_charts.h>

namespace tetralight::cli {
namespace {

constexpr size_t kMarkCount = 10;
/// Size of marks as a fraction of their distance from the eye.
constexpr double kMarkSize = 0.012;

template <class Element, class Value>
std::vector<glm::dvec3> worst_positions(const std::vector<Element>& elements, const Value& value) {
    std::vector<std::pair<double, glm::dvec3>> sorted;
    for (const Element& one : elements) sorted.emplace_back(std::abs(value(one)), one.position);
    std::ranges::stable_sort(sorted, std::ranges::greater{}, &std::pair<double, glm::dvec3>::first);
    std::vector<glm::dvec3> positions;
    for (const auto& [difference, position] : sorted) {
        if (positions.size() < kMarkCount) positions.push_back(position);
    }
    return positions;
}

/// A cross of three lines at each position.
std::vector<LineSegment> crosses(const Camera& camera, const std::vector<glm::dvec3>& positions) {
    std::vector<LineSegment> lines;
    for (const glm::dvec3& position : positions) {
        const double size = kMarkSize * std::max(view_distance(camera, position), 1e-3);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 arm(0.0);
            arm[axis] = size;
            lines.push_back({position - arm, position + arm});
        }
    }
    return lines;
}

Result<VerifyPicture> scene_picture(const Scene& scene, const ProbeVolumeView& volume,
                                    const VerifyReport& report, uint32_t thread_count) {
    RenderSettings settings;
    settings.width = 640;
    settings.height = 360;
    settings.samples_per_axis = 2;
    settings.thread_count = thread_count;
    const Camera camera = scene.cameras.empty() ? overview(scene) : scene.cameras.front();
    const auto shader = SceneShader::make(scene, volume);
    if (!shader) return shader.error();
    const auto shade = [&](const glm::dvec3& origin, glm::vec3 direction) {
        const auto shaded = shader->shade(origin, direction);
        return shaded ? shaded->radiance : sky_radiance(volume, direction);
    };
    const auto distance = [&](const glm::dvec3& origin, glm::vec3 direction) {
        return shader->distance(origin, direction).value_or(INFINITY);
    };
    Image8 image = develop(render_view(camera, settings, shade), 0.0f);
    const DepthImage depth = render_depth(camera, settings, distance);
    const auto mark = [&](const std::vector<glm::dvec3>& positions, glm::vec3 color) {
        const LineStyle style{.color = color, .opacity = 1.0f, .hidden_opacity = 0.5f, .width = 2};
        draw_lines(image, depth, camera, crosses(camera, positions), style);
    };
    mark(worst_positions(report.probes, largest_z), {1.0f, 0.2f, 0.15f});
    mark(worst_positions(report.places, luminance_difference), {1.0f, 0.85f, 0.1f});
    auto png = encode_png(image);
    if (!png) return png.error();
    return VerifyPicture{
        "The scene in the light of the volume. Crosses mark the ten probes with "
        "the largest z (red) and the ten places with the largest difference of "
        "luminance (yellow); those behind surfaces are faint.",
        std::move(*png)};
}

}  // namespace

Status write_verify_page(const std::string& path, const Scene& scene, const ProbeVolumeView& volume,
                         const VerifyReport& report, VerifyPageFacts facts, uint32_t thread_count) {
    auto picture = scene_picture(scene, volume, report, thread_count);
    if (!picture) return picture.error();
    facts.pictures = {std::move(*picture)};
    const std::string page = verify_page(report, facts);
    return write_file(path, std::as_bytes(std::span(page)));
}

}  // namespace tetralight::cli
