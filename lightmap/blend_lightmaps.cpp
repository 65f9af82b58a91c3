// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/blend_lightmaps.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>
#include <tetralight/lightmap/detail/texel_values.h>

namespace tetralight {
namespace {

Status check_same_layout(const LightmapsView& a, const LightmapsView& b) {
    const auto different = [](const std::string& what) {
        return Error{ErrorCode::InvalidArgument, "the lightmaps have " + what};
    };
    if (a.info.page_size != b.info.page_size || a.info.page_count != b.info.page_count) {
        return different(str_cat(a.info.page_count, " and ", b.info.page_count, " pages of size ",
                                 a.info.page_size, " and ", b.info.page_size));
    }
    if (a.rectangles.size() != b.rectangles.size()) {
        return different(str_cat(a.rectangles.size(), " and ", b.rectangles.size(), " rectangles"));
    }
    if (a.info.mixed_lighting != b.info.mixed_lighting) {
        return different(str_cat("mixed lighting ", name_of(a.info.mixed_lighting), " and ",
                                 name_of(b.info.mixed_lighting)));
    }
    for (size_t i = 0; i < a.rectangles.size(); ++i) {
        if (a.rectangles[i] == b.rectangles[i]) continue;
        return different(str_cat("different rectangles of instance ", i));
    }
    if (!std::ranges::equal(a.meshes, b.meshes) ||
        !std::ranges::equal(a.corner_uvs, b.corner_uvs)) {
        return different("meshes with different UVs");
    }
    if (a.light.empty() != b.light.empty()) {
        return Error{ErrorCode::InvalidArgument, "light", "",
                     "only one of the lightmaps has light for normal maps"};
    }
    return Ok{};
}

/// The part of one scenario in a blend: its weight times the scale of its halves.
struct Share {
    float weight = 0.0f;
    float scale = 1.0f;
};

/// Adds up two texels in place of those of `a`, which `out` has.
template <class Texel>
void blend_texels(Share share_a, std::span<const Texel> b, Share share_b, float scale,
                  std::vector<Texel>& out) noexcept {
    for (size_t texel = 0; texel < std::min(b.size(), out.size()); ++texel) {
        auto values = detail::values_of(out[texel], share_a.scale);
        const auto others = detail::values_of(b[texel], share_b.scale);
        for (size_t i = 0; i < values.size(); ++i) {
            values[i] = share_a.weight * values[i] + share_b.weight * others[i];
        }
        detail::store_values(values, scale, out[texel]);
    }
}

/// A copy without the members that blends do not have.
Lightmaps without_layers(const LightmapsView& view) {
    LightmapsView kept = view;
    kept.error = {};
    kept.layers = {};
    kept.layer_names = {};
    kept.layer_irradiance = {};
    kept.layer_light = {};
    return copy_lightmaps(kept);
}

}  // namespace

Result<Lightmaps> blend_lightmaps(const LightmapsView& a, const LightmapsView& b, float t) {
    if (!(t >= 0.0f && t <= 1.0f)) {
        return Error{ErrorCode::InvalidArgument, "t", str_cat(t),
                     str_cat("a blend of ", t, " is not in [0, 1]")};
    }
    if (auto status = check_same_layout(a, b); !status) return status.error();
    Lightmaps blend = without_layers(a);
    if (t == 0.0f) return blend;
    const float scale = t == 1.0f ? b.info.scale : std::max(a.info.scale, b.info.scale);
    const Share share_a{1.0f - t, a.info.scale}, share_b{t, b.info.scale};
    blend_texels(share_a, b.irradiance, share_b, scale, blend.irradiance);
    blend_texels(share_a, b.light, share_b, scale, blend.light);
    blend.info.scale = scale;
    return blend;
}

}  // namespace tetralight
