// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include <tetralight/probes/light.h>
#include <tetralight/probes/no_index.h>

// Which terms of each light are baked and which are added in real time; each counts exactly once.
// docs/mixed_lighting.md has the table of what is baked and what is added at run time.

namespace tetralight {

/// How the shadows of `Mixed` lights are made.
enum class MixedLighting : uint32_t {
    Indirect = 0,    ///< real-time shadows of everything: probes hold the bounces alone
    Shadowmask = 1,  ///< probes also hold how much of each light they see: static shadows
    Subtractive = 2  ///< the same, but only the brightest sun lights moving things in real time
};

/// "indirect", "shadowmask", "subtractive".
[[nodiscard]] const char* name_of(MixedLighting mode) noexcept;

/// The terms of one light that a bake computes.
struct BakedTerms {
    bool has_direct = false;     ///< its direct light is in the probes
    bool has_bounces = false;    ///< its bounces are in the probes
    bool has_occlusion = false;  ///< probes hold how much of it they see (point, spot, sun)

    bool operator==(const BakedTerms&) const = default;
};

/// Realtime: nothing. Mixed: bounces, and occlusion unless the mode is `Indirect`. Baked: direct
/// light and bounces. Sky and emission always count.
[[nodiscard]] BakedTerms baked_terms(LightMode light, MixedLighting mode) noexcept;

/// True if a light of this type can have occlusion. Rectangles and discs cannot.
[[nodiscard]] bool can_have_occlusion(LightType type) noexcept;

/// How a bake treated one of the volume's lights.
struct LightState {
    MixedLighting mixed_lighting = MixedLighting::Indirect;
    /// The channel of the probes' occlusion that is this light's, 0 to 3; kNoIndex: none.
    uint32_t channel = kNoIndex;
    /// The layer of its light; kNoIndex: no layer of the volume holds it.
    uint32_t layer = kNoIndex;
    /// Not zero: it is `Mixed` in the scene, but was baked because no channel was free.
    uint32_t fell_back = 0;

    bool operator==(const LightState&) const = default;
};

static_assert(sizeof(LightState) == 16 && std::is_trivially_copyable_v<LightState>);

}  // namespace tetralight
