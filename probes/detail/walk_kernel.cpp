// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/vector_kernels.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/walk_kernel.cpp>
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tetralight/probes/detail/walk.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_MAX_BYTES >= 32

using Double4 = hn::FixedTag<double, 4>;
using Vec4 = hn::Vec<Double4>;

/// One coordinate of the four corners of a tetrahedron.
struct Corners {
    Vec4 x, y, z;
};

/// Corners relative to a position. Three floats a corner are loaded as two overlapping pairs.
HWY_INLINE Corners load_corners(const float* positions, const Cell& cell, Vec4 px, Vec4 py,
                                Vec4 pz) {
    const hn::FixedTag<float, 2> pair;
    const hn::FixedTag<float, 4> four;
    const Double4 wide;
    const float* a = positions + 3 * size_t{cell.vertices[0]};
    const float* b = positions + 3 * size_t{cell.vertices[1]};
    const float* c = positions + 3 * size_t{cell.vertices[2]};
    const float* d = positions + 3 * size_t{cell.vertices[3]};
    const auto xy_ab = hn::Combine(four, hn::LoadU(pair, b), hn::LoadU(pair, a));
    const auto xy_cd = hn::Combine(four, hn::LoadU(pair, d), hn::LoadU(pair, c));
    const auto yz_ab = hn::Combine(four, hn::LoadU(pair, b + 1), hn::LoadU(pair, a + 1));
    const auto yz_cd = hn::Combine(four, hn::LoadU(pair, d + 1), hn::LoadU(pair, c + 1));
    return {hn::Sub(hn::PromoteTo(wide, hn::ConcatEven(four, xy_cd, xy_ab)), px),
            hn::Sub(hn::PromoteTo(wide, hn::ConcatOdd(four, xy_cd, xy_ab)), py),
            hn::Sub(hn::PromoteTo(wide, hn::ConcatOdd(four, yz_cd, yz_ab)), pz)};
}

/// Of (a, b, c, d): (b, a, d, c), (c, c, a, a) and (d, d, b, b), for a cofactor in each lane.
struct Shuffled {
    Vec4 swapped, first, second;
};

HWY_INLINE Shuffled shuffle(Vec4 v) {
    const Double4 wide;
    const Vec4 halves = hn::SwapAdjacentBlocks(v);
    return {hn::Reverse2(wide, v), hn::DupEven(halves), hn::DupOdd(halves)};
}

/// The signed volumes of `tetrahedron_weights`: b·(c×d), −a·(c×d), d·(a×b), −c·(a×b).
HWY_INLINE Vec4 signed_volumes(const Corners& corners) {
    const Shuffled x = shuffle(corners.x);
    const Shuffled y = shuffle(corners.y);
    const Shuffled z = shuffle(corners.z);
    const Vec4 cross_x = hn::Sub(hn::Mul(y.first, z.second), hn::Mul(y.second, z.first));
    const Vec4 cross_y = hn::Sub(hn::Mul(z.first, x.second), hn::Mul(z.second, x.first));
    const Vec4 cross_z = hn::Sub(hn::Mul(x.first, y.second), hn::Mul(x.second, y.first));
    const Vec4 dot = hn::Add(hn::Add(hn::Mul(x.swapped, cross_x), hn::Mul(y.swapped, cross_y)),
                             hn::Mul(z.swapped, cross_z));
    return hn::OddEven(hn::Neg(dot), dot);
}

/// Combines the lanes two by two; the result is in all lanes.
template <class Op>
HWY_INLINE Vec4 reduce_lanes(Vec4 v, Op op) {
    const Double4 wide;
    const Vec4 halves = op(v, hn::SwapAdjacentBlocks(v));
    return op(halves, hn::Reverse2(wide, halves));
}

/// The walks of one stream, one test a step. Whether a test finds the query or sends it on is a
/// coin toss that no processor predicts, so both are done and the results selected: a branch would
/// throw away what the other streams have begun.
class StreamWalk {
  public:
    HWY_INLINE StreamWalk(const ProbeVolumeView& volume, QueryBlock& block, size_t stream)
        : block_(block),
          starts_(&block.start[QueryBlock::start_index(0, stream)]),
          cells_(volume.cells.data()),
          positions_(volume.positions.empty() ? nullptr : &volume.positions[0].x),
          probe_count_(static_cast<uint32_t>(volume.positions.size())),
          inner_count_(volume.info.inner_cell_count),
          query_(stream * QueryBlock::kStreamSize),
          end_(query_ + block.count[stream]),
          cell_(start_or(block.cell[stream])) {}

    [[nodiscard]] HWY_INLINE bool is_done() const { return query_ == end_; }

    [[nodiscard]] HWY_INLINE uint32_t cell() const { return cell_; }

    /// Tests one cell. Precondition: not done.
    HWY_INLINE void step() {
        const Double4 wide;
        const Cell& cell = cells_[cell_];
        ++test_count_;
        if (HWY_UNLIKELY(!has_good_vertices(cell))) return leave_open(cell_);
        const Corners corners =
            load_corners(positions_, cell, hn::Set(wide, block_.x[query_]),
                         hn::Set(wide, block_.y[query_]), hn::Set(wide, block_.z[query_]));
        const Vec4 volumes = signed_volumes(corners);
        const Vec4 smallest = reduce_lanes(volumes, [](Vec4 a, Vec4 b) { return hn::Min(a, b); });
        const bool is_inside = (hn::GetLane(smallest) >= 0.0) & write_location(corners, volumes);
        const intptr_t face = hn::FindFirstTrue(wide, hn::Eq(volumes, smallest));
        const uint32_t next = cell.neighbors[static_cast<size_t>(face) & 3];
        // All ones inside: selects without a branch, which compilers do not take from `? :`.
        const uint32_t inside = 0u - static_cast<uint32_t>(is_inside);
        steps_ = (steps_ + 1) & ~inside;
        const bool is_odd = (next == previous_) | (steps_ == kWalkLimit) | (face < 0);
        const bool is_beyond = next >= inner_count_;
        if (HWY_UNLIKELY((is_odd | is_beyond) & !is_inside)) {
            return leave_open(is_odd ? cell_ : next);
        }
        query_ += inside & 1;
        previous_ = inside | cell_;
        const uint32_t start = start_or(cell_);
        cell_ = (start & inside) | (next & ~inside);
        hwy::Prefetch(&cells_[cell_]);
    }

    /// Asks for the corners that `step` reads: those of all streams come at once.
    HWY_INLINE void fetch_corners() const {
        for (const uint32_t probe : cells_[cell_].vertices) {
            hwy::Prefetch(positions_ + 3 * size_t{probe});
        }
    }

    void finish() const { block_.step_count += test_count_; }

  private:
    [[nodiscard]] HWY_INLINE bool has_good_vertices(const Cell& cell) const {
        return (cell.vertices[0] < probe_count_) & (cell.vertices[1] < probe_count_) &
               (cell.vertices[2] < probe_count_) & (cell.vertices[3] < probe_count_);
    }

    /// Where the walk of the present query begins.
    [[nodiscard]] HWY_INLINE uint32_t start_or(uint32_t cell) const {
        const uint32_t start = starts_[query_];
        const uint32_t is_none = 0u - static_cast<uint32_t>(start == kNoIndex);
        return (cell & is_none) | (start & ~is_none);
    }

    /// Writes where the query is if it is in this cell. False: the cell is a sliver that holds no
    /// position.
    HWY_INLINE bool write_location(const Corners& corners, Vec4 volumes) {
        const Double4 wide;
        const hn::FixedTag<float, 4> narrow;
        const Vec4 sum = reduce_lanes(volumes, [](Vec4 a, Vec4 b) { return hn::Add(a, b); });
        const Vec4 weights = hn::Add(hn::Div(volumes, sum), hn::Zero(wide));
        CellLocation& location = block_.location[query_];
        location.cell = cell_;
        location.ambient = 0.0f;
        hn::StoreU(hn::DemoteTo(narrow, weights), narrow, &location.weights.x);

        const Vec4 squares =
            hn::Add(hn::Add(hn::Mul(corners.x, corners.x), hn::Mul(corners.y, corners.y)),
                    hn::Mul(corners.z, corners.z));
        const double square =
            hn::GetLane(reduce_lanes(squares, [](Vec4 a, Vec4 b) { return hn::Max(a, b); }));
        const double total = hn::GetLane(sum);
        return (total > 0.0) & (total * total > kSliverRounding * (square * square * square));
    }

    HWY_INLINE void leave_open(uint32_t cell) {
        block_.unresolved[block_.unresolved_count] = static_cast<uint32_t>(query_);
        block_.unresolved_cell[block_.unresolved_count++] = cell;
        ++query_;
        previous_ = kNoIndex;
        steps_ = 0;
        cell_ = start_or(cell_);
    }

    QueryBlock& block_;
    const uint32_t* starts_;
    const Cell* cells_;
    const float* positions_;
    uint32_t probe_count_;
    uint32_t inner_count_;
    size_t query_;
    size_t end_;
    uint32_t cell_;
    uint32_t previous_ = kNoIndex;
    uint32_t steps_ = 0;
    uint64_t test_count_ = 0;
};

void walk_tetrahedra(const ProbeVolumeView& volume, QueryBlock& block) {
    StreamWalk a(volume, block, 0);
    StreamWalk b(volume, block, 1);
    StreamWalk c(volume, block, 2);
    StreamWalk d(volume, block, 3);
    while (!a.is_done() && !b.is_done() && !c.is_done() && !d.is_done()) {
        a.fetch_corners();
        b.fetch_corners();
        c.fetch_corners();
        d.fetch_corners();
        a.step();
        b.step();
        c.step();
        d.step();
    }
    while (!a.is_done()) a.step();
    while (!b.is_done()) b.step();
    while (!c.is_done()) c.step();
    while (!d.is_done()) d.step();
    for (const StreamWalk* walk : {&a, &b, &c, &d}) walk->finish();
    block.cell = {a.cell(), b.cell(), c.cell(), d.cell()};
}

#else

void walk_tetrahedra(const ProbeVolumeView& volume, QueryBlock& block) {
    scalar_kernels().walk_tetrahedra(volume, block);
}

#endif

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {

HWY_EXPORT(walk_tetrahedra);

void walk_tetrahedra_in_vectors(const ProbeVolumeView& volume, QueryBlock& block) {
    HWY_DYNAMIC_DISPATCH(walk_tetrahedra)(volume, block);
}

}  // namespace tetralight::detail

#endif
