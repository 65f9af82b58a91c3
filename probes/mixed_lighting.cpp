// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/mixed_lighting.h>

#include <cstddef>

namespace tetralight {

const char* name_of(MixedLighting mode) noexcept {
    constexpr const char* kNames[] = {"indirect", "shadowmask", "subtractive"};
    return kNames[static_cast<size_t>(mode)];
}

BakedTerms baked_terms(LightMode light, MixedLighting mode) noexcept {
    switch (light) {
        case LightMode::Realtime:
            return {};
        case LightMode::Baked:
            return {.has_direct = true, .has_bounces = true};
        case LightMode::Mixed:
            break;
    }
    return {.has_bounces = true, .has_occlusion = mode != MixedLighting::Indirect};
}

bool can_have_occlusion(LightType type) noexcept {
    return type != LightType::Rectangle && type != LightType::Disc;
}

}  // namespace tetralight
