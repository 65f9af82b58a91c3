// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include <tetralight/probes/locate.h>

// The binary form of queries, little-endian, both ways: this header and then
//
//     request:  count × three floats: world positions
//     answer:   count × SH as asked, then count × four floats of occlusion, then
//               count × CellLocation (cell, fraction of ambient light, four weights), as asked

namespace tetralight::server {

struct QueryHeader {
    static constexpr uint32_t kRequest = 0x31514c54;  ///< "TLQ1"
    static constexpr uint32_t kAnswer = 0x31414c54;   ///< "TLA1"

    static constexpr uint8_t kOcclusion = 1;
    static constexpr uint8_t kCells = 2;
    static constexpr uint8_t kIgnoreWalls = 4;

    uint32_t magic = kRequest;
    uint32_t count = 0;
    /// 0 = none, 1 = 27 floats (`IrradianceSh`), 2 = 28 floats (`PackedSh`), 3 = 27 halves.
    uint8_t sh = 1;
    /// Any of the three bits, not kIgnoreWalls alone.
    uint8_t wants = 0;
    /// `OutsidePolicy`.
    uint8_t outside = 0;
    /// 0 = the probes' floats, 1 = their half-precision copies.
    uint8_t precision = 0;
    /// Metres, for `OutsidePolicy::Ambient`; 0 = the default.
    float fade_distance = 0.0f;
};

static_assert(sizeof(QueryHeader) == 16 && std::is_trivially_copyable_v<QueryHeader>);
static_assert(sizeof(CellLocation) == 24 && std::is_trivially_copyable_v<CellLocation>);

}  // namespace tetralight::server
