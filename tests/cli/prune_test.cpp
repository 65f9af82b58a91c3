// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Prune : public CommandFixture {
  protected:
    /// Bakes the courtyard with a store.
    void bake(const char* seed) const {
        succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "-q", "--seed", seed, "--store",
                 "store"});
    }

    /// Bytes of the store.
    [[nodiscard]] uint64_t size() const {
        return run_json({"prune", "store", "--limit", "1"})["kept_bytes"];
    }
};

TEST_F(Prune, DeletesTheLeastRecentlyUsedProbes) {
    bake("1");
    const uint64_t one_bake = size();
    ASSERT_GT(one_bake, 0u);
    bake("2");
    EXPECT_EQ(size(), 2 * one_bake);

    const std::string limit = std::to_string(static_cast<double>(one_bake) * 1.5e-9);
    const Json pruned = run_json({"prune", "store", "--limit", limit});
    EXPECT_EQ(pruned["deleted_bytes"], one_bake);
    EXPECT_EQ(pruned["kept_bytes"], one_bake);
    bake("2");
    EXPECT_EQ(size(), one_bake) << "the last bake is still there";
    bake("1");
    EXPECT_EQ(size(), 2 * one_bake) << "the first one is not";
}

TEST_F(Prune, ALimitOfZeroEmptiesTheStore) {
    bake("1");
    const Json pruned = run_json({"prune", "store", "--limit", "0"});
    EXPECT_EQ(pruned["kept_bytes"], 0);
    EXPECT_GT(pruned["deleted_bytes"], 0);
}

TEST_F(Prune, LeavesOtherFoldersAlone) {
    std::filesystem::create_directory(path("folder"));
    write("folder/own.txt", "mine");
    EXPECT_TRUE(contains(fail({"prune", "folder", "--limit", "0"}), "folder: is not a store"));
    EXPECT_EQ(read("folder/own.txt"), "mine");
    EXPECT_TRUE(contains(fail({"prune", "nowhere", "--limit", "0"}), "nowhere: is not a store"));
    EXPECT_TRUE(contains(misuse({"prune", "folder"}), "--limit is required"));
}

}  // namespace
}  // namespace tetralight::test
