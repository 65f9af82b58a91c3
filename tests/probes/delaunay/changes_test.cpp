// SPDX-License-Identifier: Apache-2.0
// Sets whose positions come and go at random. TETRALIGHT_NIGHTLY=1: a million changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "tests/probes/delaunay/delaunay_checks.h"
#include "tests/probes/delaunay/point_families.h"
#include "tests/support/property.h"

namespace tetralight::test {
namespace {

/// Positions that are in a set, and those that may come.
class ChangingSet {
  public:
    ChangingSet(const std::string& family, uint64_t seed)
        : random_(seed), outside_(make_points(family, 600, seed)) {}

    /// Positions come or go: most often one, else those near one of them, at times nearly all.
    void change() {
        const bool is_coming = outside_.empty() || (!inside_.empty() && random_() % 2 == 0);
        if (is_coming || inside_.empty()) {
            insert(chosen(outside_, [](const glm::dvec3& p) { return p; }));
        } else {
            remove(chosen(inside_, [](const Inside& p) { return p.position; }));
        }
    }

    void check() const {
        expect_sound(delaunay_);
        expect_locally_delaunay(delaunay_);
        std::vector<glm::dvec3> positions;
        for (const Inside& p : inside_) positions.push_back(p.position);
        EXPECT_EQ(tetrahedra(delaunay_), tetrahedra(delaunay_of(positions)));
    }

  private:
    struct Inside {
        glm::dvec3 position;
        uint32_t vertex;
    };

    /// Takes some out of `all`.
    template <class T, class PositionOf>
    std::vector<T> chosen(std::vector<T>& all, const PositionOf& position_of) {
        std::vector<T> taken;
        if (all.empty()) return taken;
        std::swap(all[random_() % all.size()], all.back());
        const glm::dvec3 center = position_of(all.back());
        taken.push_back(all.back());
        all.pop_back();
        const auto kind = random_() % 64;
        if (kind > 8) return taken;
        const auto is_taken = [&](const T& item) {
            if (kind == 0) return random_() % 16 != 0;
            const glm::dvec3 d = position_of(item) - center;
            return d.x * d.x + d.y * d.y + d.z * d.z < 0.05;
        };
        const auto rest = std::stable_partition(all.begin(), all.end(),
                                                [&](const T& item) { return !is_taken(item); });
        taken.insert(taken.end(), rest, all.end());
        all.erase(rest, all.end());
        return taken;
    }

    void insert(const std::vector<glm::dvec3>& positions) {
        std::vector<uint32_t> vertices(positions.size());
        ASSERT_TRUE(delaunay_.insert(positions, vertices));
        for (size_t i = 0; i < positions.size(); ++i) {
            inside_.push_back({positions[i], vertices[i]});
        }
    }

    void remove(const std::vector<Inside>& removed) {
        std::vector<uint32_t> vertices;
        for (const Inside& p : removed) {
            vertices.push_back(p.vertex);
            outside_.push_back(p.position);
        }
        ASSERT_TRUE(delaunay_.remove(vertices));
    }

    std::mt19937_64 random_;
    std::vector<glm::dvec3> outside_;
    std::vector<Inside> inside_;
    DelaunayTetrahedra delaunay_;
};

class DelaunayChanges : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, DelaunayChanges, testing::ValuesIn(kPointFamilies),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_P(DelaunayChanges, GiveTheCellsOfTheSetThatIsThere) {
    constexpr int kChecked = 100;
    const int changes = is_nightly() ? 100'000 : 2'000;
    ChangingSet set(GetParam(), 1);
    for (int change = 1; change <= changes && !HasFailure(); ++change) {
        set.change();
        if (change % kChecked == 0) set.check();
    }
}

}  // namespace
}  // namespace tetralight::test
