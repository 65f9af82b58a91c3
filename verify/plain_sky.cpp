// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/plain_sky.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

/// The brightest of a pixel and those around it, which filtering mixes into it.
float brightest_around(const ImageF& image, int64_t column, int64_t row) {
    float brightest = 0.0f;
    for (int64_t y = std::max<int64_t>(0, row - 1);
         y <= std::min<int64_t>(int64_t{image.height} - 1, row + 1); ++y) {
        for (int64_t step = -1; step <= 1; ++step) {
            const int64_t x = (column + step + image.width) % image.width;
            const glm::vec3& light = image.pixels[static_cast<size_t>(y * image.width + x)];
            brightest = std::max({brightest, light.x, light.y, light.z});
        }
    }
    return brightest;
}

}  // namespace

PlainSky::PlainSky(const Environment& environment) : environment_(environment) {
    const ImageF& image = environment.image;
    if (image.pixels.empty() || environment.radiance == glm::vec3(0.0f)) return;
    double sum = 0.0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const auto row = static_cast<int64_t>(i / image.width);
        const auto column = static_cast<int64_t>(i % image.width);
        sum += double{brightest_around(image, column, row)} *
               pixel_solid_angle(static_cast<size_t>(row));
        sums_.push_back(sum);
    }
    if (!(sum > 0.0)) sums_.clear();
}

double PlainSky::row_edge(size_t row) const {
    return std::cos(kPi * static_cast<double>(row) / environment_.image.height);
}

double PlainSky::pixel_solid_angle(size_t row) const {
    return 2.0 * kPi / environment_.image.width * (row_edge(row) - row_edge(row + 1));
}

glm::vec3 PlainSky::sample(Pcg& random) const {
    const double fine = random.next() + double{random.next()} * 0x1p-24;
    const auto found = std::ranges::upper_bound(sums_, fine * sums_.back());
    const auto pixel =
        std::min<size_t>(sums_.size() - 1, static_cast<size_t>(found - sums_.begin()));
    const uint32_t width = environment_.image.width;
    const size_t row = pixel / width;
    const glm::vec2 u = random.next2();
    const double column = static_cast<double>(pixel % width) + double{u.x};
    const double angle = 2.0 * kPi * (column / width - 0.5);
    const double y = row_edge(row) + double{u.y} * (row_edge(row + 1) - row_edge(row));
    const double flat = std::sqrt(std::max(0.0, 1.0 - y * y));
    const glm::vec3 in_image(glm::dvec3(flat * std::cos(angle), y, flat * std::sin(angle)));
    return rotated_about_y(in_image, environment_.rotation_radians);
}

float PlainSky::pdf(glm::vec3 direction) const {
    const glm::vec3 d = rotated_about_y(direction, -environment_.rotation_radians);
    const ImageF& image = environment_.image;
    const double u = 0.5 + std::atan2(double{d.z}, double{d.x}) / (2.0 * kPi);
    const double v = std::acos(std::clamp(double{d.y}, -1.0, 1.0)) / kPi;
    const auto column = std::min<size_t>(image.width - 1, static_cast<size_t>(u * image.width));
    const auto row = std::min<size_t>(image.height - 1, static_cast<size_t>(v * image.height));
    const size_t pixel = row * image.width + column;
    const double own = sums_[pixel] - (pixel > 0 ? sums_[pixel - 1] : 0.0);
    return static_cast<float>(own / sums_.back() / pixel_solid_angle(row));
}

}  // namespace tetralight
