// SPDX-License-Identifier: Apache-2.0
// Changes of the sky and the sun, and volumes written with their new light.
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <new>
#include <utility>

#include <tetralight/base/file_writer.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>
#include <tetralight/probes/relight.h>
#include <tetralight/probes/volume_members.h>
#include <tetralight/runtime/detail/c_arrays.h>
#include <tetralight/runtime/detail/c_relight.h>
#include <tetralight/runtime/detail/c_volume.h>
#include <tetralight/runtime/detail/record_relit.h>
#include <tetralight/runtime/tetralight.h>

namespace tetralight::detail {

CallError check_relight(const ProbeVolumeView& volume, DistantLayer layer) {
    const char* name = layer == DistantLayer::Sky ? "sky" : "sun";
    if (volume.transfer.empty() || volume.transfer.size() != volume.positions.size() ||
        volume.sky.size() != 1) {
        return {TETRALIGHT_NOT_THERE, "the volume holds no transfer of distant light"};
    }
    if (find_layer(volume, name) == kNoIndex) {
        return {TETRALIGHT_NOT_THERE, str_cat("the volume holds no layer \"", name, '"')};
    }
    if (layer == DistantLayer::Sky) return {};
    const auto sun = movable_sun(volume);
    if (sun) return {};
    CallError wrong = sun.error();
    wrong.status = TETRALIGHT_NOT_THERE;
    return wrong;
}

}  // namespace tetralight::detail

namespace {

using namespace tetralight;
using detail::CallError;
using detail::check_floats;
using detail::check_memory;
using detail::check_pointer;
using detail::check_relight;
using detail::DistantLayer;
using detail::file_error;
using detail::finish;
using detail::record_relit;
using detail::succeed;
using detail::view_of;

/// A copy, and the metadata that replaces its own: a growing string takes up to twice its size.
size_t memory_of_copy(const ProbeVolumeView& volume) {
    size_t bytes = 2 * volume.metadata.size();
    for_each_volume_member([&](const char*, MemberUse, auto, auto member) {
        bytes += (volume.*member).size() * sizeof((volume.*member)[0]);
    });
    return bytes;
}

/// Queries and recombinations read `relit` from now on.
void store(tetralight_volume& volume, std::unique_ptr<const ProbeVolume> relit) {
    volume.relit = std::move(relit);
    volume.source = volume.relit->view();
    volume.view = volume.source;
    volume.irradiance = {};
    volume.compact = {};
    volume.layers = {};
}

/// Calls `relight(copy)` for a copy of the volume, which takes its place if that succeeds. `call`:
/// the name of the function, which metadata records.
template <class Relight>
tetralight_status relight_copy(tetralight_volume& volume, std::string_view call,
                               tetralight_error* error, Relight relight) {
    const ProbeVolumeView& from = view_of(volume);
    if (auto wrong = check_memory("a copy of the volume", memory_of_copy(from))) {
        return finish(wrong, error);
    }
    auto copy = std::unique_ptr<ProbeVolume>(new (std::nothrow) ProbeVolume(copy_volume(from)));
    if (!copy) return finish({TETRALIGHT_OUT_OF_MEMORY, "no memory for a volume"}, error);
    if (auto status = relight(*copy); !status) return finish(status.error(), error);
    copy->metadata = record_relit(copy->metadata, call);
    store(volume, std::move(copy));
    return succeed(error);
}

/// Precondition: all six numbers are finite.
CallError check_sun(const float* direction, const float* irradiance) {
    constexpr float kTolerance = 1e-3f;
    const float length = glm::length(glm::make_vec3(direction));
    if (!(std::abs(length - 1.0f) <= kTolerance)) {
        return {TETRALIGHT_BAD_VALUE,
                str_cat("direction is not a unit vector: its length is ", length)};
    }
    for (int i = 0; i < 3; ++i) {
        if (irradiance[i] >= 0.0f) continue;
        return {TETRALIGHT_BAD_VALUE, str_cat("irradiance[", i, "] is negative: ", irradiance[i])};
    }
    return {};
}

}  // namespace

tetralight_status tetralight_relight_sky(tetralight_volume* volume, const float* sky,
                                         tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_floats("sky", sky, 48)) return finish(wrong, error);
    if (auto wrong = check_relight(view_of(*volume), DistantLayer::Sky)) {
        return finish(wrong, error);
    }
    DistantLight light;
    static_assert(sizeof light == 48 * sizeof(float));
    std::memcpy(static_cast<void*>(&light), sky, sizeof light);
    return relight_copy(*volume, __func__, error,
                        [&](ProbeVolume& copy) { return relight_sky(copy, light); });
}

tetralight_status tetralight_relight_sun(tetralight_volume* volume, const float* direction,
                                         const float* irradiance,
                                         tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_floats("direction", direction, 3)) return finish(wrong, error);
    if (auto wrong = check_floats("irradiance", irradiance, 3)) return finish(wrong, error);
    if (auto wrong = check_sun(direction, irradiance)) return finish(wrong, error);
    if (auto wrong = check_relight(view_of(*volume), DistantLayer::Sun)) {
        return finish(wrong, error);
    }
    return relight_copy(*volume, __func__, error, [&](ProbeVolume& copy) {
        return relight_sun(copy, glm::make_vec3(direction), glm::make_vec3(irradiance));
    });
}

tetralight_status tetralight_save(const tetralight_volume* volume, const char* path,
                                  tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("path", path)) return finish(wrong, error);
    if (!volume->file) {
        return finish({TETRALIGHT_UNSUPPORTED, "joined volumes cannot be saved as one"}, error);
    }
    if (auto wrong = check_memory("a block of the file", kComparedBlockSize)) {
        return finish(wrong, error);
    }
    const auto status = write_probe_file(path, view_of(*volume));
    return status ? succeed(error) : finish(file_error(status.error()), error);
}
