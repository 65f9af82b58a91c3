// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/vector_kernels.h>

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/blend_kernel.cpp>
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tetralight/probes/detail/blend_probes.h>
#include <tetralight/probes/detail/write_answer.h>
#include <tetralight/probes/edge_visibility.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The floats of an answer, in the order of a compact probe: irradiance, occlusion, validity.
struct alignas(64) Values {
    std::array<float, 32> floats{};

    [[nodiscard]] float* irradiance() { return floats.data(); }

    [[nodiscard]] float* occlusion() { return floats.data() + 27; }
};

/// Σ w_i p_i over four arrays of `kCount` floats. The last vector overlaps the one before it.
template <size_t kCount>
HWY_INLINE void blend_floats(const std::array<const float*, 4>& from, const float* weights,
                             float* to) {
    const hn::CappedTag<float, (kCount < 8 ? 4 : 8)> lanes;
    const size_t step = hn::Lanes(lanes);
    for (size_t k = 0; k < kCount; k += step) {
        const size_t at = k + step <= kCount ? k : kCount - step;
        auto sum = hn::Mul(hn::Set(lanes, weights[0]), hn::LoadU(lanes, from[0] + at));
        for (size_t i = 1; i < 4; ++i) {
            sum = hn::Add(sum, hn::Mul(hn::Set(lanes, weights[i]), hn::LoadU(lanes, from[i] + at)));
        }
        hn::StoreU(sum, lanes, to + at);
    }
}

/// The same over compact probes, all 32 halves in one go.
HWY_INLINE void blend_halves(const std::array<const CompactProbe*, 4>& from, const float* weights,
                             const Values& scales, float* to) {
    const hn::CappedTag<float, 16> lanes;
    const hn::Rebind<hwy::float16_t, decltype(lanes)> halves;
    const size_t step = hn::Lanes(lanes);
    for (size_t k = 0; k < 32; k += step) {
        const auto weighted = [&](size_t i) HWY_ATTR {
            const auto* probe = reinterpret_cast<const hwy::float16_t*>(from[i]);
            return hn::Mul(hn::Set(lanes, weights[i]),
                           hn::PromoteTo(lanes, hn::LoadU(halves, probe + k)));
        };
        auto sum = weighted(0);
        for (size_t i = 1; i < 4; ++i) sum = hn::Add(sum, weighted(i));
        hn::StoreU(hn::Mul(sum, hn::LoadU(lanes, scales.floats.data() + k)), lanes, to + k);
    }
}

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE void hide_probes(const CellVisibility& cell, std::array<float, 4>& weights) {
    const auto& [a, b, c, d] = weights;
    const glm::vec4 visible = visible_weights(cell, {a, b, c, d});
    std::copy_n(&visible.x, 4, weights.begin());
}

#else

using Four = hn::FixedTag<float, 4>;
using VecFour = hn::Vec<Four>;

/// r − 1 of four codes: `edge_excess`.
HWY_INLINE VecFour edge_excesses(const uint8_t* codes) {
    const hn::Rebind<int32_t, Four> integers;
    const hn::Rebind<uint8_t, Four> bytes;
    const auto steps =
        hn::Sub(hn::PromoteTo(integers, hn::LoadU(bytes, codes)), hn::Set(integers, kUnknownEdge));
    const auto squares = hn::Mul(steps, hn::Abs(steps));
    return hn::Mul(hn::ConvertTo(Four(), squares), hn::Set(Four(), kEdgeCodeUnit));
}

/// How far corners are hidden whose L is 1 + `beyond`.
HWY_INLINE VecFour hidden_parts(VecFour beyond) {
    const Four four;
    const auto number = [&](float value) HWY_ATTR { return hn::Set(four, value); };
    const VecFour t = hn::Min(hn::Mul(beyond, number(1.0f / kVisibilityRamp)), number(1.0f));
    return hn::Mul(hn::Mul(t, t), hn::Sub(number(3.0f), hn::Mul(number(2.0f), t)));
}

HWY_INLINE float sum_of(VecFour lanes) {
    std::array<float, 4> v;
    hn::StoreU(lanes, Four(), v.data());
    return (v[0] + v[1]) + (v[2] + v[3]);
}

/// `other_walls`, a corner a lane. `first` to `third` are the parts of its three edges.
HWY_INLINE VecFour other_walls(uint32_t splits, VecFour first, VecFour second, VecFour third) {
    const Four four;
    const hn::Rebind<int32_t, Four> integers;
    const auto lane_bits = hn::Shl(hn::Set(integers, 1), hn::Iota(integers, 0));
    const auto is_split = [&](uint32_t pair) HWY_ATTR {
        const auto bits = hn::Set(integers, static_cast<int32_t>(splits >> (4 * pair)));
        return hn::RebindMask(four, hn::TestBit(bits, lane_bits));
    };
    const auto a_and_b = is_split(0), a_and_c = is_split(1), b_and_c = is_split(2);
    const auto positive = [&](VecFour v)
                              HWY_ATTR { return hn::IfThenElseZero(hn::Gt(v, hn::Zero(four)), v); };
    const VecFour a = positive(first), b = positive(second), c = positive(third);
    VecFour least = hn::Min(hn::Add(a, b), hn::Min(hn::Add(a, c), hn::Add(b, c)));
    least = hn::IfThenElse(b_and_c, least, hn::Min(least, a));
    least = hn::IfThenElse(a_and_c, least, hn::Min(least, b));
    least = hn::IfThenElse(a_and_b, least, hn::Min(least, c));
    return hn::IfThenElseZero(hn::Or(a_and_b, hn::Or(a_and_c, b_and_c)), least);
}

/// `visible_weights`, a corner a lane.
HWY_INLINE void hide_probes(const CellVisibility& cell, std::array<float, 4>& weights) {
    const Four four;
    constexpr float kLeast = std::numeric_limits<float>::min();
    const VecFour w = hn::LoadU(four, weights.data());
    const float sum = sum_of(w);
    const uint8_t* codes = cell.codes.data();
    const VecFour to_next = hn::Shuffle0321(w), to_second = hn::Shuffle1032(w),
                  to_third = hn::Shuffle2103(w);
    const VecFour first = hn::Mul(to_next, edge_excesses(codes));
    const VecFour second = hn::Mul(to_second, edge_excesses(codes + 4));
    const VecFour third = hn::Mul(to_third, edge_excesses(codes + 8));
    VecFour sums = hn::Sub(hn::Add(hn::Add(first, second), third), w);
    if (const uint32_t splits = split_bits(cell); splits != 0) {
        sums = hn::Sub(sums, other_walls(splits, hn::Add(to_next, first),
                                         hn::Add(to_second, second), hn::Add(to_third, third)));
    }
    const VecFour excess = hn::Mul(sums, hn::Set(four, 1.0f / std::max(sum, kLeast)));
    const VecFour one = hn::Set(four, 1.0f);
    const VecFour beyond = hn::IfThenElseZero(hn::Gt(excess, hn::Zero(four)), excess);
    const VecFour part = hidden_parts(beyond);
    const VecFour ratio = hn::Add(one, beyond);
    const VecFour square = hn::Div(one, hn::Mul(ratio, ratio));
    const VecFour fourth = hn::Mul(square, square);
    const VecFour hidden = hn::Mul(w, part);
    const VecFour seen = hn::Mul(w, hn::Sub(one, part));
    const VecFour steep = hn::Mul(hidden, hn::Mul(fourth, fourth));
    const float share =
        (kHiddenShare * sum_of(hn::Mul(hidden, square))) / std::max(sum_of(steep), kLeast);
    const VecFour visible = hn::Add(seen, hn::Mul(steep, hn::Set(four, share)));
    const float unit = sum / std::max(sum_of(visible), kLeast);
    hn::StoreU(hn::Mul(visible, hn::Set(four, unit)), four, weights.data());
}

#endif

/// Blends and writes the answers of located queries, whose cells exist.
class Blender {
  public:
    Blender(const ProbeVolumeView& volume, const BlendTarget& target)
        : volume_(volume),
          target_(target),
          is_compact_(volume.compact.size() == volume.positions.size()),
          has_floats_(volume.irradiance.size() == volume.positions.size()),
          has_occlusion_(volume.occlusion.size() == volume.positions.size()),
          has_walls_(target.walls == Walls::HideProbes && !volume.visibility_blocks.empty()) {
        scales_.floats.fill(1.0f);
        std::fill_n(scales_.irradiance(), 27, volume.info.compact_scale);
    }

    /// True if this code supports the volume; otherwise the scalar twin blends.
    [[nodiscard]] bool is_able() const { return is_compact_ || has_floats_; }

    HWY_INLINE void prefetch_cell(const CellLocation& location) const {
        if (location.cell < volume_.cells.size()) hwy::Prefetch(&volume_.cells[location.cell]);
        if (has_walls_) hwy::Prefetch(volume_.visibility_blocks.data() + location.cell / 32);
    }

    HWY_INLINE void prefetch_probes(const CellLocation& location) const {
        if (location.cell >= volume_.cells.size()) return;
        const uint32_t walls = has_walls_ ? find_visibility(volume_, location.cell) : kNoIndex;
        if (walls != kNoIndex) hwy::Prefetch(&volume_.cell_visibility[walls]);
        for (const uint32_t probe : volume_.cells[location.cell].vertices) {
            if (probe >= volume_.positions.size()) continue;
            if (is_compact_) {
                hwy::Prefetch(&volume_.compact[probe]);
            } else {
                hwy::Prefetch(&volume_.irradiance[probe]);
                hwy::Prefetch(&volume_.irradiance[probe].coefficients[6]);
            }
        }
    }

    HWY_INLINE void write(const CellLocation& location, size_t answer) const {
        Values values;
        blend(location, values);
        if (HWY_UNLIKELY(location.ambient > 0.0f)) add_ambient(location.ambient, values);
        if (!target_.irradiance.memory.empty()) {
            write_irradiance(target_.irradiance, answer, values.irradiance());
        }
        if (!target_.occlusion.memory.empty()) {
            write_values<4>(target_.occlusion, answer, values.occlusion());
        }
    }

  private:
    HWY_INLINE void blend(const CellLocation& location, Values& values) const {
        const Cell& cell = volume_.cells[location.cell];
        const std::array<uint32_t, 4> probes{
            vertex_at(volume_, cell, 0), vertex_at(volume_, cell, 1), vertex_at(volume_, cell, 2),
            vertex_at(volume_, cell, 3)};
        std::array<float, 4> visible;
        const float* weights = &location.weights.x;
        const uint32_t walls = has_walls_ ? find_visibility(volume_, location.cell) : kNoIndex;
        if (walls != kNoIndex) {
            std::copy_n(weights, 4, visible.begin());
            hide_probes(volume_.cell_visibility[walls], visible);
            weights = visible.data();
        }
        if (is_compact_) {
            const CompactProbe* first = volume_.compact.data();
            return blend_halves(
                {first + probes[0], first + probes[1], first + probes[2], first + probes[3]},
                weights, scales_, values.irradiance());
        }
        const auto irradiance = [&](size_t i) {
            return &volume_.irradiance[probes[i]].coefficients[0].x;
        };
        blend_floats<27>({irradiance(0), irradiance(1), irradiance(2), irradiance(3)}, weights,
                         values.irradiance());
        if (!has_occlusion_) {
            std::fill_n(values.occlusion(), 4, 1.0f - location.ambient);
        } else if (!target_.occlusion.memory.empty()) {
            const auto occlusion = [&](size_t i) { return &volume_.occlusion[probes[i]].x; };
            blend_floats<4>({occlusion(0), occlusion(1), occlusion(2), occlusion(3)}, weights,
                            values.occlusion());
        }
    }

    void add_ambient(float share, Values& values) const {
        const float* ambient = &volume_.info.ambient.coefficients[0].x;
        for (int k = 0; k < 27; ++k) values.irradiance()[k] += share * ambient[k];
        for (int k = 0; k < 4; ++k) values.occlusion()[k] += share;
    }

    const ProbeVolumeView& volume_;
    const BlendTarget& target_;
    bool is_compact_;
    bool has_floats_;
    bool has_occlusion_;
    bool has_walls_;
    Values scales_;
};

void blend(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
           const BlendTarget& target) {
    const Blender blender(volume, target);
    if (!blender.is_able()) return scalar_kernels().blend(volume, locations, target);
    // Probes are fetched by the indices in their cell, so the cell must have arrived before.
    constexpr size_t kCellsAhead = 48;
    constexpr size_t kProbesAhead = 12;
    const size_t count = locations.size();
    for (size_t i = 0; i < std::min(kCellsAhead, count); ++i) blender.prefetch_cell(locations[i]);
    for (size_t i = 0; i < std::min(kProbesAhead, count); ++i) {
        blender.prefetch_probes(locations[i]);
    }
    for (size_t i = 0; i < count; ++i) {
        if (i + kCellsAhead < count) blender.prefetch_cell(locations[i + kCellsAhead]);
        if (i + kProbesAhead < count) blender.prefetch_probes(locations[i + kProbesAhead]);
        if (HWY_UNLIKELY(locations[i].cell >= volume.cells.size())) {
            scalar_kernels().blend(
                volume, locations.subspan(i, 1),
                {target.answers.subspan(i, 1), target.irradiance, target.occlusion, target.walls});
        } else {
            blender.write(locations[i], target.answers[i]);
        }
    }
}

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {

HWY_EXPORT(blend);

void blend_in_vectors(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
                      const BlendTarget& target) {
    HWY_DYNAMIC_DISPATCH(blend)(volume, locations, target);
}

}  // namespace tetralight::detail

#endif
