// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/vector_positions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace tetralight::conformance {
namespace {

/// Makes positions of one volume.
class Places {
  public:
    Places(const ProbeVolumeView& volume, Numbers& numbers)
        : volume_(volume), numbers_(numbers), scale_(std::max(double{volume.info.extent}, 1.0)) {}

    std::vector<VectorPosition> made;

    void add(const std::string& kind, const glm::dvec3& local) {
        const glm::dvec3 world = volume_.info.world_origin + local;
        made.push_back({kind, glm::vec3(world), glm::vec3(numbers_.direction())});
    }

    /// Adds positions that `draw` gives where their location fits, until there are `count`.
    template <class Draw, class Fits>
    void add_where(size_t count, const std::string& kind, Draw draw, Fits fits) {
        constexpr int kMostTries = 10'000;
        for (int i = 0; i < kMostTries && made.size() < count; ++i) {
            add(kind, draw());
            if (!fits(locate(volume_, made.back().position))) made.pop_back();
        }
    }

    /// A blend of the first `count` corners of an inner cell; all with the same weight, or at
    /// random.
    [[nodiscard]] glm::dvec3 blend(uint32_t cell, int count, bool is_random) {
        glm::dvec3 place(0.0);
        double sum = 0.0;
        for (int i = 0; i < count; ++i) {
            const double weight = is_random ? numbers_.between(0.05, 1.0) : 1.0;
            place += weight * glm::dvec3(volume_.positions[volume_.cells[cell].vertices[i]]);
            sum += weight;
        }
        return place / sum;
    }

    [[nodiscard]] uint32_t inner_cell() {
        return static_cast<uint32_t>(numbers_.below(volume_.info.inner_cell_count));
    }

    /// Off a plane or line, whose cells do not depend on that.
    [[nodiscard]] glm::dvec3 off_axis() {
        const glm::dvec3& axis = volume_.info.axis;
        const double distance = numbers_.between(-0.5, 0.5) * scale_;
        switch (volume_.info.dimension) {
            case Dimension::Plane:
                return distance * axis;
            case Dimension::Line:
                return distance * glm::cross(axis, numbers_.direction());
            default:
                return glm::dvec3(0.0);
        }
    }

    [[nodiscard]] glm::dvec3 inside() {
        const int count = cell_vertex_count(volume_.info.dimension);
        return blend(inner_cell(), count, true) + off_axis();
    }

    /// Outside, `low` to `high` extents from a probe.
    [[nodiscard]] glm::dvec3 outside(double low, double high) {
        const size_t probe = numbers_.below(volume_.positions.size());
        return glm::dvec3(volume_.positions[probe]) +
               numbers_.direction() * numbers_.between(low, high) * scale_;
    }

    void add_inside() {
        const int count = cell_vertex_count(volume_.info.dimension);
        for (const size_t probe : {size_t{0}, volume_.positions.size() - 1}) {
            add("probe", glm::dvec3(volume_.positions[probe]));
        }
        for (int i = 0; i < 2 && count >= 3; ++i) add("edge", blend(inner_cell(), 2, false));
        for (int i = 0; i < 2 && count == 4; ++i) add("face", blend(inner_cell(), 3, true));
        for (int i = 0; i < 4; ++i) add("inside", inside());
    }

    void add_outside() {
        for (int i = 0; i < 4; ++i) add("near", outside(0.5, 2.0));
        for (const double distance : {30.0, 3000.0}) add("far", outside(distance, 2.0 * distance));
        for (const double distance : {1e6, 1e25}) add("beyond", outside(distance, 2.0 * distance));
    }

    void add_not_finite() {
        constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        for (const glm::vec3& position :
             {glm::vec3(kNan, 0, 0), glm::vec3(0, kInfinity, 1), glm::vec3(1, 2, -kInfinity)}) {
            made.push_back({"not finite", position, glm::vec3(0, 1, 0)});
        }
    }

  private:
    const ProbeVolumeView& volume_;
    Numbers& numbers_;
    double scale_;
};

}  // namespace

std::vector<VectorPosition> make_vector_positions(const ProbeVolumeView& volume, Numbers& numbers) {
    Places places(volume, numbers);
    if (volume.cells.empty()) {
        places.add("near", {1, 2, 3});
    } else {
        places.add_inside();
        places.add_outside();
    }
    places.add_not_finite();
    return places.made;
}

std::vector<VectorPosition> make_hidden_positions(const ProbeVolumeView& volume, size_t count,
                                                  Numbers& numbers) {
    Places places(volume, numbers);
    places.add_where(
        count, "hidden", [&] { return places.inside(); },
        [&](const CellLocation& location) {
            return visible_location(volume, location) != location;
        });
    return places.made;
}

std::vector<VectorPosition> make_outside_positions(const ProbeVolumeView& volume, size_t count,
                                                   Numbers& numbers) {
    Places places(volume, numbers);
    places.add_where(
        count, "near", [&] { return places.outside(0.5, 3.0); },
        [&](const CellLocation& location) {
            return location.cell >= volume.info.inner_cell_count;
        });
    return places.made;
}

}  // namespace tetralight::conformance
