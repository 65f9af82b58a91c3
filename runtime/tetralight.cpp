// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/tetralight.h>

#include <cmath>
#include <cstring>

#include <tetralight/probes/probe_file.h>
#include <tetralight/runtime/detail/c_arrays.h>
#include <tetralight/runtime/detail/c_open.h>
#include <tetralight/runtime/detail/c_receivers.h>
#include <tetralight/runtime/detail/c_volume.h>
#include <tetralight/runtime/pack_instances.h>
#include <tetralight/runtime/shader_volume.h>

struct tetralight_shader_volume {
    tetralight::ShaderVolume volume;
};

namespace {

using namespace tetralight;
using detail::CallError;
using detail::check_aligned;
using detail::check_array;
using detail::check_floats;
using detail::check_memory;
using detail::check_normals;
using detail::check_pointer;
using detail::check_receivers;
using detail::check_walls;
using detail::elements_of;
using detail::file_error;
using detail::finish;
using detail::open_bytes;
using detail::open_path;
using detail::output_of;
using detail::PositionBlocks;
using detail::succeed;
using detail::view_of;

static_assert(TETRALIGHT_NO_CELL == kNoIndex);
static_assert(sizeof(PackedSh) == sizeof(tetralight_light::packed));

CallError check_outside(const tetralight_batch& batch) {
    if (batch.outside > TETRALIGHT_AMBIENT) {
        return {TETRALIGHT_BAD_VALUE, str_cat("outside is out of range: ", batch.outside)};
    }
    const bool fades = batch.outside == TETRALIGHT_AMBIENT;
    if (fades && !(batch.fade_distance > 0.0f && std::isfinite(batch.fade_distance))) {
        return {TETRALIGHT_BAD_VALUE,
                str_cat("fade_distance is not positive and finite: ", batch.fade_distance)};
    }
    return {};
}

OutsideHull outside_of(const tetralight_batch& batch) {
    OutsideHull outside;
    outside.policy = static_cast<OutsidePolicy>(batch.outside);
    if (outside.policy == OutsidePolicy::Ambient) outside.fade_distance = batch.fade_distance;
    return outside;
}

constexpr detail::ElementLayout kPosition{12, 4};
constexpr detail::ElementLayout kHint{4, 4};
constexpr detail::ElementLayout kVector{16, 4};

CallError check_report(const tetralight_report* report) {
    return check_aligned("report", report, alignof(tetralight_report));
}

CallError check_hints(const tetralight_array& hints, size_t count) {
    if (!hints.data) return {};
    return check_array("hints", hints, count, kHint, detail::Gaps::Refused);
}

CallError check_batch(const tetralight_batch& batch) {
    if (batch.sh_format > TETRALIGHT_SH_HALF) {
        return {TETRALIGHT_BAD_VALUE, str_cat("sh_format is out of range: ", batch.sh_format)};
    }
    if (auto wrong = check_outside(batch)) return wrong;
    if (auto wrong = check_walls(batch.walls)) return wrong;
    if (batch.count == 0) return {};
    if (!batch.sh.data && !batch.occlusion.data) {
        return {TETRALIGHT_BAD_POINTER, "sh and occlusion are both NULL"};
    }
    if (auto wrong = check_array("positions", batch.positions, batch.count, kPosition)) {
        return wrong;
    }
    if (auto wrong = check_hints(batch.hints, batch.count)) return wrong;
    if (auto wrong = check_receivers(batch.rendering_layers, batch.radii, batch.count)) {
        return wrong;
    }
    if (auto wrong = check_normals(batch.normals, batch.normal_offset, batch.count)) return wrong;
    const auto format = static_cast<ShFormat>(batch.sh_format);
    if (batch.sh.data) {
        const size_t value = value_size(format);
        if (auto wrong =
                check_array("sh", batch.sh, batch.count, {value_count(format) * value, value})) {
            return wrong;
        }
    }
    if (!batch.occlusion.data) return {};
    return check_array("occlusion", batch.occlusion, batch.count, kVector);
}

std::span<uint32_t> hints_of(const tetralight_array& hints, size_t begin, size_t count) {
    if (!hints.data) return {};
    return {static_cast<uint32_t*>(hints.data) + begin, count};
}

/// Positions [begin, begin + positions.size()) of a checked batch.
InterpolationBatch part_of(const tetralight_batch& batch, size_t begin,
                           std::span<const glm::vec3> positions) {
    InterpolationBatch part;
    part.positions = positions;
    part.hints = hints_of(batch.hints, begin, positions.size());
    part.outside = outside_of(batch);
    part.walls = static_cast<Walls>(batch.walls);
    const size_t count = positions.size();
    part.rendering_layers = elements_of<uint32_t>(batch.rendering_layers, begin, count);
    part.radii = elements_of<float>(batch.radii, begin, count);
    part.normals = elements_of<glm::vec3>(batch.normals, begin, count);
    part.normal_offset = batch.normal_offset;
    const auto format = static_cast<ShFormat>(batch.sh_format);
    if (batch.sh.data) {
        const size_t size = value_count(format) * value_size(format);
        const detail::ByteRows rows = output_of(batch.sh, size, begin);
        part.irradiance = strided(rows.memory, format, rows.stride);
    }
    if (batch.occlusion.data) {
        const detail::ByteRows rows = output_of(batch.occlusion, kVector.size, begin);
        part.occlusion = strided_occlusion(rows.memory, rows.stride);
    }
    return part;
}

CallError check_instances(const tetralight_instances& instances) {
    if (auto wrong = check_walls(instances.walls)) return wrong;
    if (instances.count == 0) return {};
    constexpr const char* kNames[] = {"sh[0]", "sh[1]", "sh[2]", "sh[3]",
                                      "sh[4]", "sh[5]", "sh[6]"};
    if (auto wrong = check_array("positions", instances.positions, instances.count, kPosition)) {
        return wrong;
    }
    if (auto wrong = check_hints(instances.hints, instances.count)) return wrong;
    for (size_t i = 0; i < std::size(kNames); ++i) {
        if (auto wrong = check_array(kNames[i], instances.sh[i], instances.count, kVector,
                                     detail::Gaps::Refused)) {
            return wrong;
        }
    }
    if (auto wrong =
            check_receivers(instances.rendering_layers, instances.radii, instances.count)) {
        return wrong;
    }
    if (!instances.occlusion.data) return {};
    return check_array("occlusion", instances.occlusion, instances.count, kVector);
}

InstanceBatch part_of(const tetralight_instances& instances, size_t begin,
                      std::span<const glm::vec3> positions) {
    const auto vectors = [&](size_t i) {
        return std::span(static_cast<glm::vec4*>(instances.sh[i].data) + begin, positions.size());
    };
    InstanceBatch part;
    part.positions = positions;
    part.hints = hints_of(instances.hints, begin, positions.size());
    part.arrays = {vectors(0), vectors(1), vectors(2), vectors(3),
                   vectors(4), vectors(5), vectors(6)};
    part.walls = static_cast<Walls>(instances.walls);
    part.rendering_layers =
        elements_of<uint32_t>(instances.rendering_layers, begin, positions.size());
    part.radii = elements_of<float>(instances.radii, begin, positions.size());
    if (instances.occlusion.data) {
        const detail::ByteRows rows = output_of(instances.occlusion, kVector.size, begin);
        part.occlusion = strided_occlusion(rows.memory, rows.stride);
    }
    return part;
}

/// Calls `answer(begin, positions)` for each block of positions and adds up the reports.
template <class Answer>
tetralight_status answer_blocks(const tetralight_const_array& positions, size_t count,
                                tetralight_report* report, tetralight_error* error, Answer answer) {
    tetralight_report sum{0, 0};
    PositionBlocks blocks(positions, count);
    while (blocks.next()) {
        const Result<BatchReport> report_of_block = answer(blocks.begin(), blocks.positions());
        if (!report_of_block) return finish(report_of_block.error(), error);
        sum.not_finite_count += report_of_block->not_finite_count;
        sum.step_count += report_of_block->step_count;
    }
    if (report) *report = sum;
    return succeed(error);
}

void write_light(const ProbeVolumeView& volume, const CellLocation& location,
                 tetralight_light& light) {
    const InterpolatedProbe probe = interpolate(volume, location);
    const PackedSh packed = pack_sh(probe.irradiance);
    std::memcpy(light.packed, &packed, sizeof light.packed);
    std::memcpy(light.occlusion, &probe.occlusion, sizeof light.occlusion);
    std::memcpy(light.weights, &location.weights, sizeof light.weights);
    light.cell = location.cell;
}

template <class Element>
tetralight_const_array bytes_of(const std::vector<Element>& elements) {
    return {elements.data(), elements.size() * sizeof(Element), 0};
}

}  // namespace

uint32_t tetralight_version(void) noexcept {
    return TETRALIGHT_VERSION_NUMBER;
}

const char* tetralight_version_string(void) noexcept {
    return TETRALIGHT_VERSION_STRING;
}

tetralight_status tetralight_open(const char* path, tetralight_volume** volume,
                                  tetralight_error* error) noexcept {
    return open_path(open_probe_file, path, "volume", volume, error);
}

tetralight_status tetralight_open_memory(const void* bytes, size_t size, tetralight_volume** volume,
                                         tetralight_error* error) noexcept {
    return open_bytes(open_probe_memory, bytes, size, "volume", volume, error);
}

tetralight_status tetralight_open_lazy(const char* path, tetralight_volume** volume,
                                       tetralight_error* error) noexcept {
    return open_path(open_probe_file_lazy, path, "volume", volume, error);
}

tetralight_status tetralight_verify(const tetralight_volume* volume,
                                    tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (!volume->file) return succeed(error);
    const auto status = verify(*volume->file);
    if (!status) return finish(file_error(status.error()), error);
    return succeed(error);
}

void tetralight_close(tetralight_volume* volume) noexcept {
    delete volume;
}

tetralight_status tetralight_get_info(const tetralight_volume* volume, tetralight_info* info,
                                      tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("info", info)) return finish(wrong, error);
    const ProbeVolumeView& view = view_of(*volume);
    const bool is_compact = !view.compact.empty();
    *info = {view.probe_count(),
             static_cast<uint32_t>(view.cells.size()),
             view.info.inner_cell_count,
             static_cast<uint32_t>(view.info.dimension),
             is_compact || !view.irradiance.empty() ? 1u : 0u,
             view.occlusion.empty() ? 0u : 1u,
             static_cast<uint32_t>(view.layers.size())};
    return succeed(error);
}

tetralight_status tetralight_query(const tetralight_volume* volume, const float* position,
                                   uint32_t* hint, tetralight_light* light,
                                   tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("position", position)) return finish(wrong, error);
    if (auto wrong = check_aligned("hint", hint, alignof(uint32_t))) return finish(wrong, error);
    if (auto wrong = check_pointer("light", light)) return finish(wrong, error);
    const glm::vec3 at(position[0], position[1], position[2]);
    const ProbeVolumeView& view = view_of(*volume);
    const CellLocation location = locate(view, at, hint ? *hint : kNoIndex);
    write_light(view, location, *light);
    if (hint) *hint = location.cell;
    return succeed(error);
}

tetralight_status tetralight_query_batch(const tetralight_volume* volume,
                                         const tetralight_batch* batch, tetralight_report* report,
                                         tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("batch", batch)) return finish(wrong, error);
    if (auto wrong = check_report(report)) return finish(wrong, error);
    if (auto wrong = check_batch(*batch)) return finish(wrong, error);
    return answer_blocks(batch->positions, batch->count, report, error,
                         [&](size_t begin, std::span<const glm::vec3> positions) {
                             return interpolate(view_of(*volume),
                                                part_of(*batch, begin, positions));
                         });
}

tetralight_status tetralight_pack_instances(const tetralight_volume* volume,
                                            const tetralight_instances* instances,
                                            tetralight_report* report,
                                            tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("instances", instances)) return finish(wrong, error);
    if (auto wrong = check_report(report)) return finish(wrong, error);
    if (auto wrong = check_instances(*instances)) return finish(wrong, error);
    return answer_blocks(instances->positions, instances->count, report, error,
                         [&](size_t begin, std::span<const glm::vec3> positions) {
                             return pack_instances(view_of(*volume),
                                                   part_of(*instances, begin, positions));
                         });
}

tetralight_status tetralight_pack_sh(const float* coefficients, float* packed,
                                     tetralight_error* error) noexcept {
    if (auto wrong = check_floats("coefficients", coefficients, 27)) return finish(wrong, error);
    if (auto wrong = check_pointer("packed", packed)) return finish(wrong, error);
    IrradianceSh sh;
    std::memcpy(static_cast<void*>(&sh), coefficients, sizeof sh);
    const PackedSh made = pack_sh(sh);
    std::memcpy(packed, &made, sizeof made);
    return succeed(error);
}

tetralight_status tetralight_sample_sh9(const float* packed, const float* normal, float* rgb,
                                        tetralight_error* error) noexcept {
    if (auto wrong = check_floats("packed", packed, 28)) return finish(wrong, error);
    if (auto wrong = check_floats("normal", normal, 3)) return finish(wrong, error);
    if (auto wrong = check_pointer("rgb", rgb)) return finish(wrong, error);
    PackedSh sh;
    std::memcpy(static_cast<void*>(&sh), packed, sizeof sh);
    const glm::vec3 light = sample_sh9(sh, {normal[0], normal[1], normal[2]});
    std::memcpy(rgb, &light, sizeof light);
    return succeed(error);
}

tetralight_status tetralight_make_shader_volume(const tetralight_volume* volume,
                                                tetralight_shader_volume** made,
                                                tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("made", made)) return finish(wrong, error);
    const ProbeVolumeView& view = view_of(*volume);
    if (auto wrong = check_memory("a shader volume", shader_volume_memory(view))) {
        return finish(wrong, error);
    }
    *made = new tetralight_shader_volume{make_shader_volume(view)};
    return succeed(error);
}

tetralight_status tetralight_get_shader_array(const tetralight_shader_volume* made, uint32_t index,
                                              tetralight_const_array* array,
                                              tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("made", made)) return finish(wrong, error);
    if (auto wrong = check_pointer("array", array)) return finish(wrong, error);
    const ShaderVolume& volume = made->volume;
    switch (index) {
        case 0:
            *array = {&volume.constants, sizeof volume.constants, 0};
            return succeed(error);
        case 1:
            *array = bytes_of(volume.positions);
            return succeed(error);
        case 2:
            *array = bytes_of(volume.light);
            return succeed(error);
        case 3:
            *array = bytes_of(volume.cells);
            return succeed(error);
        case 4:
            *array = bytes_of(volume.hull_rays);
            return succeed(error);
        case 5:
            *array = bytes_of(volume.seeds);
            return succeed(error);
        case 6:
            *array = bytes_of(volume.walls);
            return succeed(error);
        default:
            break;
    }
    return finish({TETRALIGHT_BAD_VALUE, str_cat("there is no shader array ", index)}, error);
}

void tetralight_free_shader_volume(tetralight_shader_volume* made) noexcept {
    delete made;
}
