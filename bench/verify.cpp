// SPDX-License-Identifier: Apache-2.0
// What a second path tracer says of bakes at default settings: `tetralight verify` of the subjects
// of `bake`.
#include <algorithm>
#include <cmath>
#include <utility>

#include <tetralight/base/error_text.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/verify_volume.h>

namespace tetralight::bench {
namespace {

BakedVolume bake(const BakeSubject& subject) {
    ProbeGroup group;
    group.name = subject.name;
    group.positions = subject.probes;
    BakeVolumeSettings settings;
    settings.bake = with_default_target(settings.bake);
    auto baked = bake_volume(subject.scene, {&group, 1}, settings);
    require(bool(baked), baked ? "" : error_text(baked.error()));
    return std::move(*baked);
}

void verify(const BakeSubject& subject, const Options& options) {
    const BakedVolume baked = bake(subject);
    VerifySettings settings;
    settings.place_count = 0;
    settings.probe_count = options.is_quick ? 50 : 400;
    const auto outcome = verify_volume(subject.scene, baked.volume.view(), settings);
    require(bool(outcome), outcome ? "" : error_text(outcome.error()));
    double within = 1.0, mean_z = 0.0, undecided = 0.0;
    for (const VerifyChannel& channel : outcome->channels) {
        within = std::min(within, channel.within_3_sigma);
        undecided = std::max(undecided, channel.undecided);
        if (std::abs(channel.mean_z) > std::abs(mean_z)) mean_z = channel.mean_z;
    }
    report("verify.within_3_sigma." + subject.name, 100.0 * within, "% of the decided probes");
    report("verify.mean_z." + subject.name, mean_z, "standard errors, the largest of the channels");
    report("verify.undecided." + subject.name, 100.0 * undecided, "% of the probes");
}

}  // namespace

void bench_verify(const Options& options) {
    std::vector<BakeSubject> subjects = bake_subjects(options);
    if (is_selected(options, "white_room")) subjects.push_back(white_room());
    for (const BakeSubject& subject : subjects) verify(subject, options);
}

}  // namespace tetralight::bench
