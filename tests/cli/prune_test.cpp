// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Prune : public CommandFixture {
  protected:
    /// Bakes the courtyard with a store; gives the rays that were needed.
    [[nodiscard]] Json bake(const char* seed) const {
        return run_json(
            {"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--seed", seed, "--store", "store"});
    }
};

TEST_F(Prune, DeletesTheLeastRecentlyUsedProbes) {
    (void)bake("1");
    const Json one = run_json({"prune", "store", "--limit", "1"});
    EXPECT_EQ(one["deleted_bytes"], 0);
    const uint64_t size = one["kept_bytes"];
    ASSERT_GT(size, 0u);

    (void)bake("2");
    const std::string limit = std::to_string(static_cast<double>(size) * 1.5e-9);
    const Json pruned = run_json({"prune", "store", "--limit", limit});
    EXPECT_EQ(pruned["deleted_bytes"], size);
    EXPECT_EQ(pruned["kept_bytes"], size);
    EXPECT_EQ(bake("2")["rays"], 0) << "the last bake is still there";
    EXPECT_GT(bake("1")["rays"], 0);
}

TEST_F(Prune, ALimitOfZeroEmptiesTheStore) {
    (void)bake("1");
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
