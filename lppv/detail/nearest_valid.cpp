// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/nearest_valid.h>

#include <algorithm>
#include <limits>

#include <tetralight/base/contract.h>

namespace tetralight::detail {
namespace {

/// The points of one grid line whose nearest valid point is known, each as a parabola of squared
/// distance.
class Line {
  public:
    explicit Line(double spacing) : square_(spacing > 0.0 ? spacing * spacing : 1.0) {}

    void clear() { parabolas_.clear(); }

    /// Adds a point; positions must increase. Keeps only parabolas that are lowest somewhere.
    void add(double position, double square_distance, uint32_t point) {
        double begin = -std::numeric_limits<double>::infinity();
        while (!parabolas_.empty()) {
            const Parabola& last = parabolas_.back();
            // The position of equal distance.
            begin =
                0.5 * (position + last.position +
                       (square_distance - last.height) / (square_ * (position - last.position)));
            if (begin > last.begin) break;
            parabolas_.pop_back();
            begin = -std::numeric_limits<double>::infinity();
        }
        parabolas_.push_back({position, square_distance, begin, point});
    }

    struct Nearest {
        double square_distance;
        uint32_t point;
    };

    /// The lowest parabola at a position; positions must increase from 0. Precondition: !empty().
    [[nodiscard]] Nearest at(double position) {
        if (position == 0.0) next_ = 0;
        while (next_ + 1 < parabolas_.size() && parabolas_[next_ + 1].begin < position) ++next_;
        const Parabola& lowest = parabolas_[next_];
        const double offset = position - lowest.position;
        return {lowest.height + square_ * offset * offset, lowest.point};
    }

    [[nodiscard]] bool empty() const { return parabolas_.empty(); }

  private:
    struct Parabola {
        double position;
        double height;
        double begin;  ///< it is the lowest from here on
        uint32_t point;
    };

    double square_;
    std::vector<Parabola> parabolas_;
    size_t next_ = 0;
};

/// For each point the nearest valid point found so far, and its squared distance.
struct Found {
    std::vector<uint32_t> nearest;
    std::vector<double> square_distance;
};

void pass_line(Found& found, Line& line, size_t first, size_t stride, uint32_t count) {
    line.clear();
    for (uint32_t i = 0; i < count; ++i) {
        const size_t point = first + i * stride;
        if (found.nearest[point] == kNoIndex) continue;
        line.add(i, found.square_distance[point], found.nearest[point]);
    }
    if (line.empty()) return;
    for (uint32_t i = 0; i < count; ++i) {
        const Line::Nearest nearest = line.at(i);
        found.nearest[first + i * stride] = nearest.point;
        found.square_distance[first + i * stride] = nearest.square_distance;
    }
}

}  // namespace

std::vector<uint32_t> nearest_valid(glm::uvec3 resolution, glm::dvec3 spacing,
                                    std::span<const float> validity, float min_validity) {
    const size_t size = size_t{resolution.x} * resolution.y * resolution.z;
    TETRALIGHT_ASSERT(validity.size() == size, "one validity per grid point");
    Found found{std::vector<uint32_t>(size, kNoIndex), std::vector<double>(size, 0.0)};
    for (size_t i = 0; i < size; ++i) {
        if (validity[i] >= min_validity) found.nearest[i] = static_cast<uint32_t>(i);
    }
    size_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
        Line line(spacing[axis]);
        const size_t span = stride * resolution[axis];
        for (size_t first = 0; first < size; ++first) {
            if (first % span < stride) {
                pass_line(found, line, first, stride, resolution[axis]);
            }
        }
        stride = span;
    }
    return std::move(found.nearest);
}

}  // namespace tetralight::detail
