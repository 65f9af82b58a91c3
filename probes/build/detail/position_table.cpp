// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/position_table.h>

#include <bit>

#include <tetralight/probes/no_index.h>

namespace tetralight::detail {
namespace {

uint64_t hash(const glm::dvec3& position) {
    uint64_t result = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double coordinate = position[axis] + 0.0;  // -0 equals 0
        result = (result ^ std::bit_cast<uint64_t>(coordinate)) * 0x9e3779b97f4a7c15u;
        result ^= result >> 32;
    }
    return result;
}

}  // namespace

PositionTable::PositionTable(std::span<const glm::dvec3> positions)
    : positions_(positions), slots_(std::bit_ceil(2 * positions.size() + 1), kNoIndex) {
    for (uint32_t i = 0; i < positions.size(); ++i) {
        size_t slot = static_cast<size_t>(hash(positions[i])) & last_slot();
        while (slots_[slot] != kNoIndex) slot = (slot + 1) & last_slot();
        slots_[slot] = i;
    }
}

uint32_t PositionTable::find(const glm::dvec3& position) const {
    for (auto slot = static_cast<size_t>(hash(position));; ++slot) {
        const uint32_t index = slots_[slot & last_slot()];
        if (index == kNoIndex || positions_[index] == position) return index;
    }
}

}  // namespace tetralight::detail
