// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

// What Tetralight and a program that tetrahedralizes for it (`tetralight-cgal`,
// `tetralight-tetgen`) say to each other. Little-endian, packed:
//
//     stdin    StreamHeader{kPositionsMagic, count}, then `count` positions, 3 doubles each
//     stdout   StreamHeader{kTetrahedraMagic, count}, then `count` StreamTetrahedron
//     stderr   why it failed, in one line; the exit code is then not 0
//
// The last letter of the magics is the version of both records.

namespace tetralight::programs {

using StreamMagic = std::array<char, 8>;

inline constexpr StreamMagic kPositionsMagic{'T', 'L', 'p', 'o', 's', 'i', 't', '1'};
inline constexpr StreamMagic kTetrahedraMagic{'T', 'L', 't', 'e', 't', 'r', 'a', '1'};

struct StreamHeader {
    StreamMagic magic{};
    uint64_t count = 0;
};

/// No neighbor: the face is a face of the convex hull.
inline constexpr uint32_t kStreamNoNeighbor = 0xffffffff;

/// Positively oriented: dot(v1 − v0, cross(v2 − v0, v3 − v0)) > 0. `neighbors[i]` is the number of
/// the tetrahedron across the face opposite `vertices[i]`.
struct StreamTetrahedron {
    std::array<uint32_t, 4> vertices{};
    std::array<uint32_t, 4> neighbors{};
};

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(StreamHeader) == 16 && std::is_trivially_copyable_v<StreamHeader>);
static_assert(sizeof(StreamTetrahedron) == 32 && std::is_trivially_copyable_v<StreamTetrahedron>);

}  // namespace tetralight::programs
