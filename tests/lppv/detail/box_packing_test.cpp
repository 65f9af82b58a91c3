// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/box_packing.h>

#include <gtest/gtest.h>

#include <random>

namespace tetralight::detail {
namespace {

struct Placed {
    glm::uvec3 min;
    glm::uvec3 size;
};

bool overlap(const Placed& a, const Placed& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.min[axis] + a.size[axis] <= b.min[axis]) return false;
        if (b.min[axis] + b.size[axis] <= a.min[axis]) return false;
    }
    return true;
}

void expect_apart(const std::vector<Placed>& boxes, glm::uvec3 size) {
    for (size_t i = 0; i < boxes.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_LE(boxes[i].min[axis] + boxes[i].size[axis], size[axis]);
        }
        for (size_t j = 0; j < i; ++j) ASSERT_FALSE(overlap(boxes[i], boxes[j]));
    }
}

TEST(BoxPacking, HandsOutBoxesThatDoNotOverlapWhileOthersComeBack) {
    const glm::uvec3 size(32, 24, 16);
    BoxPacking packing(size);
    std::vector<Placed> boxes;
    std::mt19937 engine(1);
    for (int step = 0; step < 2000; ++step) {
        if (!boxes.empty() && engine() % 5 < 2) {
            const size_t i = engine() % boxes.size();
            packing.release(boxes[i].min, boxes[i].size);
            boxes[i] = boxes.back();
            boxes.pop_back();
            continue;
        }
        const glm::uvec3 wanted(1 + engine() % 9, 1 + engine() % 7, 1 + engine() % 5);
        if (const auto min = packing.allocate(wanted)) boxes.push_back({*min, wanted});
        if (step % 50 == 0) expect_apart(boxes, size);
    }
    uint64_t used = 0;
    for (const Placed& box : boxes) used += uint64_t{box.size.x} * box.size.y * box.size.z;
    EXPECT_EQ(packing.used(), used);
    EXPECT_GT(used, packing.capacity() / 2);
}

TEST(BoxPacking, FillsABoxOfEqualOnesWhole) {
    BoxPacking packing({32, 16, 16});
    for (int i = 0; i < 128; ++i) ASSERT_TRUE(packing.allocate({4, 4, 4}));
    EXPECT_FALSE(packing.allocate({1, 1, 1}));
    EXPECT_EQ(packing.used(), packing.capacity());
}

TEST(BoxPacking, TakesTheWholeBoxAgainWhenAllIsBack) {
    BoxPacking packing({8, 8, 8});
    std::vector<Placed> boxes;
    for (const glm::uvec3 size : {glm::uvec3(3, 4, 5), glm::uvec3(8, 2, 1), glm::uvec3(2, 2, 2)}) {
        boxes.push_back({*packing.allocate(size), size});
    }
    for (const Placed& box : boxes) packing.release(box.min, box.size);
    EXPECT_EQ(packing.allocate({8, 8, 8}), glm::uvec3(0));
}

TEST(BoxPacking, RefusesWhatIsTooLarge) {
    EXPECT_FALSE(BoxPacking({8, 8, 8}).allocate({9, 1, 1}));
}

}  // namespace
}  // namespace tetralight::detail
