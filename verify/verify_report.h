// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/probes/sh.h>

// What `tetralight verify` finds: the light of a probe volume beside the light that a referee
// traced at the same positions.
//
//     TracedLight at probes and places → VerifyProbe[], VerifyPlace[] → make_verify_report
//         → VerifyReport → check_limits → VerifyFailure[]

namespace tetralight {

/// The light that a referee found at one position.
struct TracedLight {
    /// Mean irradiance over all normals, of each channel, and its standard error.
    glm::dvec3 mean{0.0};
    glm::dvec3 error{0.0};
    /// Irradiance of each normal. `mean` is that of its first coefficient.
    IrradianceSh irradiance;
    /// Paths traced for `mean`.
    uint64_t sample_count = 0;

    bool operator==(const TracedLight&) const = default;
};

/// A probe of the volume that was compared. Vectors have one element a channel: red, green, blue.
/// Light is mean irradiance over all normals, in the unit of the scene's lights.
struct VerifyProbe {
    /// Index in the volume.
    uint32_t probe = 0;
    /// World space, with the virtual offset: where its light was sampled.
    glm::dvec3 position{0.0};
    glm::dvec3 volume{0.0};
    /// The same light as irradiance of each normal.
    IrradianceSh irradiance;
    /// Standard error of `volume`, from that which the volume stores. 0: not known, or no light.
    glm::dvec3 volume_error{0.0};
    TracedLight traced;
    /// (volume − traced) / √(volume_error² + traced.error² + rounding²); 0 if both are dark.
    glm::dvec3 z{0.0};
    /// False: the combined error bar is too wide to decide whether they agree, or not known.
    std::array<bool, 3> is_decided{true, true, true};
    /// Difference of irradiance, root mean square over all normals and channels, divided by the
    /// irradiance of the referee in the same mean. It includes noise. 0 if the referee has the mean
    /// irradiance alone.
    double directional_difference = 0.0;

    bool operator==(const VerifyProbe&) const = default;
};

/// A free place between the probes that was compared.
struct VerifyPlace {
    /// World space.
    glm::dvec3 position{0.0};
    /// No probe of its cell sees it.
    bool is_unseen = false;
    /// It lies outside the hull of the probes.
    bool is_outside = false;
    /// Mean irradiance over all normals that a query of the volume returns.
    glm::dvec3 answer{0.0};
    TracedLight traced;
    /// The answer is much brighter, or much darker, than the traced light (`VerifyRules`).
    bool is_leak = false;
    bool is_dark = false;

    bool operator==(const VerifyPlace&) const = default;
};

/// When a difference counts.
struct VerifyRules {
    /// Probes with a wider error bar are undecided: relative to the traced light, or to
    /// `least_share` of the mean light of the compared probes in the channel if that is more.
    double widest_bar = 0.02;
    double least_share = 0.01;
    /// A place is a leak if its luminance is more than this fraction above the traced one, and by
    /// more than `leak_floor` of the mean light of all places and three standard errors. Dark
    /// places are as much below it.
    double leak_ratio = 0.5;
    double leak_floor = 0.05;

    bool operator==(const VerifyRules&) const = default;
};

/// Of `VerifyReport::channels`.
inline constexpr std::array<const char*, 3> kChannelNames{"red", "green", "blue"};

/// One channel of the mean irradiance at probes. Shares and means are over decided probes, but for
/// `undecided` and `mean_difference`, which are over all compared probes.
struct VerifyChannel {
    uint64_t decided_count = 0;
    double within_3_sigma = 1.0;
    double mean_z = 0.0;
    /// Root mean square of z: 1 if differences are as large as error bars say.
    double rms_z = 0.0;
    double undecided = 0.0;
    /// Mean of (volume − traced) over the mean of the traced light.
    double mean_difference = 0.0;

    bool operator==(const VerifyChannel&) const = default;
};

/// Differences of luminance at places, |answer − traced| over the mean traced light of all places.
struct VerifyInterpolation {
    double mean = 0.0;
    double median = 0.0;
    double p95 = 0.0;
    /// The mean difference that noise of the traced light alone would give.
    double noise = 0.0;

    bool operator==(const VerifyInterpolation&) const = default;
};

/// Probes of the volume that are not compared, because their light is not that of their position.
struct VerifyExcluded {
    uint64_t dilated = 0;     ///< light of probes around them
    uint64_t inside = 0;      ///< inside geometry
    uint64_t overridden = 0;  ///< an adjustment volume changes their light

    [[nodiscard]] uint64_t total() const { return dilated + inside + overridden; }

    bool operator==(const VerifyExcluded&) const = default;
};

/// A limit that the volume does not keep.
struct VerifyFailure {
    /// The setting, for example "min_within".
    std::string setting;
    /// One sentence for people.
    std::string message;

    bool operator==(const VerifyFailure&) const = default;
};

struct VerifyReport {
    /// "path tracer" or "Cycles 3.4.1".
    std::string referee;
    /// What the referee shares with the baker, and where the volume differs from it by its
    /// settings; one sentence each.
    std::vector<std::string> notes;
    /// Reflections of the referee; `kAllBounces` (bake/all_bounces.h) = no limit.
    uint32_t bounces = 0;
    uint64_t seed = 0;
    uint64_t volume_probe_count = 0;
    VerifyExcluded excluded;
    VerifyRules rules;
    /// In the order of the volume.
    std::vector<VerifyProbe> probes;
    /// In the order in which they were drawn.
    std::vector<VerifyPlace> places;
    /// Red, green, blue.
    std::array<VerifyChannel, 3> channels;
    /// Median of `directional_difference`.
    double directional_difference = 0.0;
    VerifyInterpolation interpolation;
    /// Mean traced luminance of the places.
    double mean_light = 0.0;
    /// Shares of the places.
    double leak_share = 0.0;
    double dark_share = 0.0;
    double unseen_share = 0.0;
    double outside_share = 0.0;
    /// Paths of all positions.
    uint64_t sample_count = 0;
    /// Probes and places that were not traced, because the time was over.
    uint64_t untraced_count = 0;
    std::vector<VerifyFailure> failures;

    bool operator==(const VerifyReport&) const = default;
};

/// What a volume has to keep.
struct VerifyLimits {
    /// Least share of decided probes within three combined standard errors, in each channel.
    double min_within = 0.99;
    /// Largest |mean z| in each channel, beyond three times its standard error 1 / √decided.
    double max_mean_z = 0.1;
    double max_undecided = 0.1;
    double max_leak_share = 0.05;
    double max_unseen_share = 0.05;
    /// Largest mean difference of interpolated light.
    double max_interpolation = 0.25;

    bool operator==(const VerifyLimits&) const = default;
};

/// Mean irradiance over all normals.
[[nodiscard]] glm::dvec3 mean_over_normals(const IrradianceSh& irradiance) noexcept;

/// Luminance of linear Rec.709.
[[nodiscard]] double luminance(const glm::dvec3& light) noexcept;

/// Sets z, `is_decided`, leaks and all figures from the light of `probes` and `places`, by `rules`.
void summarize(VerifyReport& report);

/// The whole report as one JSON object, indented by nothing.
[[nodiscard]] std::string verify_report_json(const VerifyReport& report);

}  // namespace tetralight
