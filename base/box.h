// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace tetralight {

/// An axis-aligned box, corners included. `Vec` is a vector type whose `min`, `max`, `all` and
/// `lessThanEqual` are found beside it, such as a `glm::vec` (include <glm/common.hpp> and
/// <glm/vector_relational.hpp> where they are used).
template <class Vec>
struct Box {
    using Number = typename Vec::value_type;

    Vec min{};
    Vec max{};

    /// The box that contains nothing: its union with another box is the other box.
    [[nodiscard]] static constexpr Box empty() noexcept {
        static_assert(std::numeric_limits<Number>::has_infinity);
        constexpr Number kInfinity = std::numeric_limits<Number>::infinity();
        return {Vec(kInfinity), Vec(-kInfinity)};
    }

    [[nodiscard]] constexpr Vec center() const noexcept {
        return Number(0.5) * min + Number(0.5) * max;
    }

    [[nodiscard]] constexpr Vec size() const noexcept { return max - min; }

    bool operator==(const Box&) const = default;
};

/// The smallest box that contains both.
template <class Vec>
[[nodiscard]] Box<Vec> union_of(const Box<Vec>& a, const Box<Vec>& b) noexcept {
    return {min(a.min, b.min), max(a.max, b.max)};
}

/// The smallest box that contains a box and a point.
template <class Vec>
[[nodiscard]] Box<Vec> union_of(const Box<Vec>& box, const Vec& point) noexcept {
    return {min(box.min, point), max(box.max, point)};
}

/// What two boxes have in common; if nothing, `min` exceeds `max` along an axis.
template <class Vec>
[[nodiscard]] Box<Vec> intersection_of(const Box<Vec>& a, const Box<Vec>& b) noexcept {
    return {max(a.min, b.min), min(a.max, b.max)};
}

template <class Vec>
[[nodiscard]] bool contains(const Box<Vec>& box, const Vec& point) noexcept {
    return all(lessThanEqual(box.min, point)) && all(lessThanEqual(point, box.max));
}

}  // namespace tetralight
