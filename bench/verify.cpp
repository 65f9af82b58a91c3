// SPDX-License-Identifier: Apache-2.0
// What a second path tracer says of bakes at default settings: `tetralight verify` of the subjects
// of `bake`.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <tetralight/base/error_text.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/verify_volume.h>

namespace tetralight::bench {
namespace {

BakedVolume bake(const BakeSubject& subject, uint64_t seed) {
    ProbeGroup group;
    group.name = subject.name;
    group.positions = subject.probes;
    BakeVolumeSettings settings;
    settings.bake = with_default_target(settings.bake);
    settings.bake.seed = seed;
    auto baked = bake_volume(subject.scene, {&group, 1}, settings);
    require(bool(baked), baked ? "" : error_text(baked.error()));
    return std::move(*baked);
}

/// Means over bakes and traces with different random numbers: the mean z of n probes varies by 1 /
/// sqrt(n) by chance.
void verify(const BakeSubject& subject, const Options& options) {
    const uint64_t rounds = options.is_quick ? 1 : 16;
    double within = 0.0, undecided = 0.0;
    std::array<double, 3> mean_z{};
    for (uint64_t round = 0; round < rounds; ++round) {
        const BakedVolume baked = bake(subject, round);
        VerifySettings settings;
        settings.place_count = 0;
        settings.probe_count = options.is_quick ? 50 : 400;
        settings.seed = 100 + round;
        const auto outcome = verify_volume(subject.scene, baked.volume.view(), settings);
        require(bool(outcome), outcome ? "" : error_text(outcome.error()));
        double least_within = 1.0, most_undecided = 0.0;
        for (std::size_t c = 0; c < outcome->channels.size(); ++c) {
            const VerifyChannel& channel = outcome->channels[c];
            least_within = std::min(least_within, channel.within_3_sigma);
            most_undecided = std::max(most_undecided, channel.undecided);
            mean_z[c] += channel.mean_z / double(rounds);
        }
        within += least_within / double(rounds);
        undecided += most_undecided / double(rounds);
    }
    const double largest = *std::max_element(
        mean_z.begin(), mean_z.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    report("verify.within_3_sigma." + subject.name, 100.0 * within, "% of the decided probes");
    report("verify.mean_z." + subject.name, largest,
           "standard errors, the largest of the channels");
    report("verify.undecided." + subject.name, 100.0 * undecided, "% of the probes");
}

}  // namespace

void bench_verify(const Options& options) {
    std::vector<BakeSubject> subjects = bake_subjects(options);
    if (is_selected(options, "white_room")) subjects.push_back(white_room());
    for (const BakeSubject& subject : subjects) verify(subject, options);
}

}  // namespace tetralight::bench
