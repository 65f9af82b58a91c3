// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/lightmaps.h>

#include <algorithm>
#include <cmath>

#include <tetralight/lightmap/lightmap_members.h>

namespace tetralight {

LightmapsView Lightmaps::view() const noexcept {
    LightmapsView view;
    view.info = info;
    for_each_lightmap_member(
        [&](const char*, auto owner, auto viewed) { view.*viewed = this->*owner; });
    return view;
}

Lightmaps copy_lightmaps(const LightmapsView& view) {
    Lightmaps lightmaps;
    lightmaps.info = view.info;
    for_each_lightmap_member([&](const char*, auto owner, auto viewed) {
        (lightmaps.*owner).assign((view.*viewed).begin(), (view.*viewed).end());
    });
    return lightmaps;
}

float lightmap_scale(float largest) noexcept {
    if (largest == 0.0f) return 1.0f;
    constexpr int kLargestExponent = 15;
    int exponent = 0;
    const float fraction = std::frexp(largest, &exponent);  // largest = fraction · 2^exponent
    if (fraction == 0.5f) --exponent;
    const float scale = std::ldexp(1.0f, exponent - kLargestExponent);
    return std::clamp(scale, 1.0f / kLargestLightmapScale, kLargestLightmapScale);
}

void set_page_transform(LightmapRectangle& rectangle, uint32_t page_size) noexcept {
    const auto size = static_cast<float>(page_size);
    const glm::vec2 texels(rectangle.width, rectangle.height), corner(rectangle.x, rectangle.y);
    rectangle.scale = texels / size;
    rectangle.offset = corner / size;
}

}  // namespace tetralight
