// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/sparse_lppv.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/uniform_receiver.h>

namespace tetralight {
namespace {

constexpr double kLargestBlock = 1 << 20;
constexpr size_t kBlocksPerTask = kBatchTaskSize / kSparseBlockPoints;

/// 21 bits per axis; the order of keys is that of `sorted`.
uint64_t key_of(int64_t x, int64_t y, int64_t z) {
    constexpr int64_t kOffset = int64_t{1} << 20;
    return static_cast<uint64_t>(z + kOffset) << 42 | static_cast<uint64_t>(y + kOffset) << 21 |
           static_cast<uint64_t>(x + kOffset);
}

glm::ivec3 block_of(uint64_t key) {
    constexpr uint64_t kMask = (uint64_t{1} << 21) - 1;
    const auto coordinate = [&](int shift) {
        return static_cast<int>(key >> shift & kMask) - (1 << 20);
    };
    return {coordinate(0), coordinate(21), coordinate(42)};
}

}  // namespace

SparseBlocks::SparseBlocks(double spacing) : spacing_(spacing) {
    TETRALIGHT_ASSERT(spacing > 0.0 && std::isfinite(spacing), "spacing is positive");
}

Status SparseBlocks::add_box(const glm::dvec3& min, const glm::dvec3& max) {
    std::array<int64_t, 3> first{}, last{};
    double count = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        // The grid cell of a position lies between the point below it and the next one.
        const double a = std::floor(std::floor(min[axis] / spacing_) / kSparseBlockSide);
        const double b = std::floor((std::floor(max[axis] / spacing_) + 1.0) / kSparseBlockSide);
        if (!(a >= -kLargestBlock && b < kLargestBlock && a <= b)) {
            return Error{ErrorCode::InvalidArgument,
                         str_cat("a box from ", min[axis], " to ", max[axis],
                                 " m is outside the sparse grid: with a spacing of ", spacing_,
                                 " m it ends ", kLargestBlock * kSparseBlockSide * spacing_,
                                 " m from the origin")};
        }
        count *= b - a + 1.0;
        first[static_cast<size_t>(axis)] = static_cast<int64_t>(a);
        last[static_cast<size_t>(axis)] = static_cast<int64_t>(b);
    }
    const auto too_many = [](double blocks) {
        return Error{ErrorCode::InvalidArgument,
                     str_cat("a sparse grid of ", blocks * kSparseBlockPoints,
                             " points or more is too large: the limit is ",
                             kMaxSparseBlocks * kSparseBlockPoints)};
    };
    if (count > kMaxSparseBlocks) return too_many(count);
    for (int64_t z = first[2]; z <= last[2]; ++z) {
        for (int64_t y = first[1]; y <= last[1]; ++y) {
            for (int64_t x = first[0]; x <= last[0]; ++x) keys_.insert(key_of(x, y, z));
        }
    }
    if (keys_.size() > kMaxSparseBlocks) return too_many(static_cast<double>(keys_.size()));
    return Ok{};
}

std::vector<glm::ivec3> SparseBlocks::sorted() const {
    std::vector<uint64_t> keys(keys_.begin(), keys_.end());
    std::ranges::sort(keys);
    std::vector<glm::ivec3> blocks;
    blocks.reserve(keys.size());
    for (const uint64_t key : keys) blocks.push_back(block_of(key));
    return blocks;
}

namespace detail {

SparseLppv empty_sparse_lppv(const ProbeVolumeView& volume, const SparseBlocks& blocks) {
    SparseLppv lppv{blocks.spacing(), blocks.sorted(), {}, {}};
    lppv.irradiance.resize(lppv.blocks.size() * kSparseBlockPoints);
    if (!volume.occlusion.empty()) lppv.occlusion.resize(lppv.irradiance.size());
    return lppv;
}

size_t SparseFillTasks::count() const noexcept {
    return (lppv.blocks.size() + kBlocksPerTask - 1) / kBlocksPerTask;
}

void SparseFillTasks::run(size_t task) const {
    const size_t first = task * kBlocksPerTask;
    const size_t last = std::min(first + kBlocksPerTask, lppv.blocks.size());
    std::vector<glm::vec3> positions;
    positions.reserve((last - first) * kSparseBlockPoints);
    for (size_t block = first; block < last; ++block) {
        const glm::dvec3 corner(lppv.blocks[block] * kSparseBlockSide);
        for (uint32_t i = 0; i < kSparseBlockPoints; ++i) {
            const glm::dvec3 point(i & 7, i >> 3 & 7, i >> 6);
            positions.emplace_back((corner + point) * lppv.spacing);
        }
    }
    const size_t begin = first * kSparseBlockPoints;
    InterpolationBatch batch;
    batch.positions = positions;
    batch.irradiance = std::span(lppv.irradiance).subspan(begin, positions.size());
    if (!lppv.occlusion.empty()) {
        batch.occlusion = std::span(lppv.occlusion).subspan(begin, positions.size());
    }
    UniformReceiver everywhere;
    everywhere.set(receiver, batch);
    const auto report = interpolate(volume, batch);
    TETRALIGHT_ASSERT(report, "the outputs of a task have one element per position");
}

}  // namespace detail
}  // namespace tetralight
