// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/image_renderer.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <tetralight/bake/image/fraction_byte.h>
#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/runtime/tone_map.h>

namespace tetralight {
namespace {

constexpr float kMiddleGrey = 0.18f;

class View {
  public:
    View(const Camera& camera, const RenderSettings& settings, const TraceView& trace)
        : projection_(camera, settings.width, settings.height),
          settings_(settings),
          trace_(trace) {}

    [[nodiscard]] glm::vec3 pixel(uint32_t column, uint32_t row) const {
        const uint32_t n = settings_.samples_per_axis;
        glm::vec3 sum(0.0f);
        for (uint32_t i = 0; i < n * n; ++i) {
            const double x = column + (i % n + 0.5) / n;
            const double y = row + (i / n + 0.5) / n;
            const ViewRay ray = projection_.ray(x, y);
            sum += trace_(ray.origin, ray.direction);
        }
        return sum / static_cast<float>(n * n);
    }

  private:
    Projection projection_;
    const RenderSettings& settings_;
    const TraceView& trace_;
};

}  // namespace

PictureHeight picture_height(const Camera& camera) {
    if (camera.half_height) return {2.0 * *camera.half_height, 0.0};
    return {0.0, 2.0 * std::tan(0.5 * camera.fov_y_radians)};
}

double view_distance(const Camera& camera, const glm::dvec3& position) {
    const glm::dvec3 offset = position - glm::dvec3(camera.world_from_camera[3]);
    return camera.half_height ? -glm::dot(offset, glm::dvec3(camera.world_from_camera[2]))
                              : glm::length(offset);
}

Projection::Projection(const Camera& camera, uint32_t width, uint32_t height)
    : camera_(camera), width_(width), height_(height) {
    const PictureHeight all = picture_height(camera);
    pixel_ = {all.at_eye / height, all.per_metre / height};
}

ViewRay Projection::ray(double x, double y) const {
    const glm::dvec2 place(x - 0.5 * width_, 0.5 * height_ - y);
    const glm::dvec4 origin(pixel_.at_eye * place, 0.0, 1.0);
    const glm::dvec4 direction(pixel_.per_metre * place, -1.0, 0.0);
    const glm::dmat4& world_from_view = camera_.world_from_camera;
    return {glm::dvec3(world_from_view * origin),
            glm::vec3(glm::normalize(glm::dvec3(world_from_view * direction)))};
}

glm::dvec3 Projection::view_from_world(const glm::dvec3& position) const {
    const glm::dmat4& world_from_view = camera_.world_from_camera;
    const glm::dvec3 offset = position - glm::dvec3(world_from_view[3]);
    return {glm::dot(offset, glm::dvec3(world_from_view[0])),
            glm::dot(offset, glm::dvec3(world_from_view[1])),
            glm::dot(offset, glm::dvec3(world_from_view[2]))};
}

glm::dvec3 Projection::picture_from_view(const glm::dvec3& position) const {
    const double pixels = 1.0 / pixel_size(-position.z);
    return {0.5 * width_ + position.x * pixels, 0.5 * height_ - position.y * pixels, -position.z};
}

double Projection::depth(glm::vec3 direction, double distance) const {
    return -distance * glm::dot(glm::dvec3(direction), glm::dvec3(camera_.world_from_camera[2]));
}

Camera look_at(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_radians) {
    // Points that are too close in double precision give no direction: look along -Z.
    const glm::dvec3 offset = eye - target;
    const double distance = glm::length(offset);
    const glm::dvec3 back = distance > 1e-100 ? offset / distance : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 up(0.0, 1.0, 0.0);
    glm::dvec3 right = glm::cross(up, back);
    right = glm::length(right) > 1e-9 ? glm::normalize(right) : glm::dvec3(1.0, 0.0, 0.0);
    Camera camera;
    camera.world_from_camera = {glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0),
                                glm::dvec4(back, 0.0), glm::dvec4(eye, 1.0)};
    camera.fov_y_radians = fov_y_radians;
    return camera;
}

ImageF render_view(const Camera& camera, const RenderSettings& settings, const TraceView& trace) {
    ImageF image{settings.width, settings.height, {}};
    image.pixels.resize(size_t{settings.width} * settings.height);
    const View view(camera, settings, trace);
    parallel_for(settings.height, settings.thread_count, [&](size_t row) {
        for (uint32_t column = 0; column < settings.width; ++column) {
            image.pixels[row * settings.width + column] =
                view.pixel(column, static_cast<uint32_t>(row));
        }
    });
    return image;
}

float automatic_exposure(const ImageF& radiance) {
    // Reinhard et al. 2002, eq. 1.
    const glm::dvec3 luminance_weights(0.2126, 0.7152, 0.0722);
    double sum = 0.0;
    size_t count = 0;
    for (const glm::vec3& pixel : radiance.pixels) {
        const double luminance = glm::dot(glm::dvec3(pixel), luminance_weights);
        if (!(luminance > 0.0)) continue;
        sum += std::log(luminance);
        ++count;
    }
    return count == 0
               ? 1.0f
               : kMiddleGrey / static_cast<float>(std::exp(sum / static_cast<double>(count)));
}

Image8 quantized(const ImageF& colors) {
    Image8 image{colors.width, colors.height, {}};
    image.pixels.reserve(colors.pixels.size());
    for (const glm::vec3& pixel : colors.pixels)
        image.pixels.push_back(
            {fraction_byte(pixel.x), fraction_byte(pixel.y), fraction_byte(pixel.z), 255});
    return image;
}

Image8 develop(const ImageF& radiance, float exposure) {
    if (exposure <= 0.0f) exposure = automatic_exposure(radiance);
    Image8 image{radiance.width, radiance.height, {}};
    image.pixels.reserve(radiance.pixels.size());
    for (const glm::vec3& pixel : radiance.pixels) {
        const glm::vec3 display = tone_map_neutral(pixel * exposure);
        image.pixels.push_back({srgb8_from_linear(display.x), srgb8_from_linear(display.y),
                                srgb8_from_linear(display.z), 255});
    }
    return image;
}

}  // namespace tetralight
