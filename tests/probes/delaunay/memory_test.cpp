// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <vector>

#include <tetralight/probes/delaunay/delaunay_triangles.h>
#include "tests/probes/delaunay/delaunay_checks.h"
#include "tests/probes/delaunay/point_families.h"

namespace tetralight::test {
namespace {

/// Gives memory until it was asked so many times, and knows what has not been freed.
class ShortMemory {
  public:
    explicit ShortMemory(size_t requests_left) : requests_left_(requests_left) {}

    [[nodiscard]] MemorySource source() { return {resize, this}; }

    [[nodiscard]] bool is_all_freed() const { return blocks_.empty(); }

    void set_requests_left(size_t requests_left) { requests_left_ = requests_left; }

  private:
    static void* resize(void* context, void* memory, size_t byte_count) {
        auto& self = *static_cast<ShortMemory*>(context);
        EXPECT_TRUE(memory == nullptr || self.blocks_.contains(memory));
        if (byte_count > 0 && self.requests_left_ == 0) return nullptr;
        self.blocks_.erase(memory);
        if (byte_count == 0) {
            std::free(memory);
            return nullptr;
        }
        --self.requests_left_;
        void* resized = std::realloc(memory, byte_count);
        self.blocks_.insert(resized);
        return resized;
    }

    size_t requests_left_;
    std::set<void*> blocks_;
};

constexpr size_t kEnough = 1'000'000;

TEST(DelaunayMemory, RunsShortAtAnyRequestOfAnInsertion) {
    const auto points = make_points("random", 300, 1);
    const auto expected = tetrahedra(delaunay_of(points));
    std::vector<uint32_t> vertices(points.size());
    size_t failures = 0;
    for (bool is_enough = false; !is_enough; ++failures) {
        ShortMemory memory(failures);
        {
            DelaunayTetrahedra delaunay(memory.source());
            const Status status = delaunay.insert(points, vertices);
            is_enough = static_cast<bool>(status);
            if (!is_enough) {
                EXPECT_EQ(status.error().code, ErrorCode::OutOfResources);
                EXPECT_TRUE(delaunay.cells().empty());
                EXPECT_EQ(delaunay.last_vertex(), 0u);
                memory.set_requests_left(kEnough);
                ASSERT_TRUE(delaunay.insert(points, vertices));
            }
            EXPECT_EQ(tetrahedra(delaunay), expected);
        }
        EXPECT_TRUE(memory.is_all_freed());
    }
    EXPECT_GT(failures, 10u);
}

TEST(DelaunayMemory, RunsShortAtAnyRequestOfARemoval) {
    const auto points = make_points("random", 200, 2);
    std::vector<uint32_t> vertices(points.size());
    size_t failures = 0;
    for (bool is_enough = false; !is_enough; ++failures) {
        ShortMemory memory(kEnough);
        {
            DelaunayTetrahedra delaunay(memory.source());
            ASSERT_TRUE(delaunay.insert(points, vertices));
            memory.set_requests_left(failures);
            const Status status = delaunay.remove(std::span(vertices).first(60));
            is_enough = static_cast<bool>(status);
            if (!is_enough) {
                EXPECT_EQ(status.error().code, ErrorCode::OutOfResources);
                EXPECT_TRUE(delaunay.cells().empty());
            }
        }
        EXPECT_TRUE(memory.is_all_freed());
    }
    EXPECT_GT(failures, 10u);
}

TEST(DelaunayMemory, RunsShortInAPlane) {
    std::vector<glm::dvec2> points;
    for (const glm::dvec3& p : make_points("random", 100, 3)) points.emplace_back(p.x, p.y);
    size_t failures = 0;
    for (bool is_enough = false; !is_enough; ++failures) {
        ShortMemory memory(failures);
        {
            DelaunayTriangles triangles(memory.source());
            is_enough = static_cast<bool>(triangles.make(points));
            EXPECT_EQ(triangles.cells().empty(), !is_enough);
        }
        EXPECT_TRUE(memory.is_all_freed());
    }
    EXPECT_GT(failures, 3u);
}

}  // namespace
}  // namespace tetralight::test
