// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <random>
#include <sstream>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class WorldCommand : public CommandFixture {
  protected:
    WorldCommand() { bake_courtyard("v.probes"); }

    /// In the courtyard and around it.
    static std::string positions(int count) {
        std::mt19937 engine(1);
        std::uniform_real_distribution<float> coordinate(-12.0f, 12.0f);
        std::ostringstream text;
        for (int i = 0; i < count; ++i) {
            text << coordinate(engine) << " " << 0.5f * coordinate(engine) << " "
                 << coordinate(engine) << "\n";
        }
        return text.str();
    }

    [[nodiscard]] std::vector<std::string> names_in(const std::string& name) const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path(name))) {
            names.push_back(entry.path().filename().string());
        }
        std::ranges::sort(names);
        return names;
    }
};

TEST_F(WorldCommand, QueriesHaveTheBytesOfThoseOfTheVolume) {
    const Json report = run_json({"world", "v.probes", "--tile", "8", "-o", "w"});
    EXPECT_GT(report["tiles"], 3);
    EXPECT_EQ(names_in("w").size(), report["tiles"].get<size_t>() + 2);
    write("p.txt", positions(500) + "nan 0 0\n");
    for (const Arguments& options : std::vector<Arguments>{
             {"--json"},
             {"--to", "text"},
             {"--to", "csv"},
             {"--to", "raw"},
             {"--json", "--precision", "half"},
             {"--json", "--walls", "ignore"},
             {"--json", "--outside", "clamp"},
             {"--json", "--outside", "ambient", "--fade", "3", "--radius", "0.3"}}) {
        Arguments of_volume{"query", "v.probes", "p.txt", "-q"},
            of_world{"query", "w", "p.txt", "-q"};
        of_volume.insert(of_volume.end(), options.begin(), options.end());
        of_world.insert(of_world.end(), options.begin(), options.end());
        const std::string expected = succeed(of_volume).out;
        ASSERT_FALSE(expected.empty());
        EXPECT_EQ(succeed(of_world).out, expected) << options.back();
    }
}

TEST_F(WorldCommand, InfoVerifiesAllTiles) {
    const Json made = run_json({"world", "v.probes", "--tile", "20,20,20", "-o", "w"});
    EXPECT_EQ(made["tile_counts"], Json({2, 1, 2}));
    EXPECT_EQ(run_json({"info", "w"}), made);
    EXPECT_TRUE(contains(succeed({"info", "w"}).out, "and one outside"));
    for (const std::string& name : names_in("w")) {
        if (name.ends_with(".probes")) succeed({"info", "w/" + name});
    }
    const std::string name = names_in("w")[0];
    std::string bytes = read("w/" + name);
    bytes[bytes.size() / 2] ^= 1;
    write("w/" + name, bytes);
    EXPECT_TRUE(contains(fail({"info", "w"}), "w: tile "));
    write("p.txt", positions(500));
    EXPECT_TRUE(contains(fail({"query", "w", "p.txt"}), name));
    std::filesystem::remove(path("w/" + name));
    EXPECT_TRUE(contains(fail({"info", "w"}), name));
}

TEST_F(WorldCommand, ANewWorldReplacesTheOldOne) {
    succeed({"world", "v.probes", "--tile", "8", "-o", "w"});
    const auto first = names_in("w");
    const Json second = run_json({"world", "v.probes", "--tile", "12", "-o", "w"});
    EXPECT_EQ(names_in("w").size(), second["tiles"].get<size_t>() + 2);
    succeed({"world", "v.probes", "--tile", "8", "-o", "w"});
    EXPECT_EQ(names_in("w"), first) << "files are named after their content";
}

TEST_F(WorldCommand, AFailureLeavesTheOldWorld) {
    succeed({"world", "v.probes", "--tile", "10", "-o", "w"});
    const auto before = names_in("w");
    EXPECT_TRUE(contains(fail({"world", "v.probes", "--tile", "0.0001", "-o", "w"}), "tiles"));
    EXPECT_TRUE(contains(fail({"world", "nothing.probes", "-o", "w"}), "nothing.probes"));
    EXPECT_EQ(names_in("w"), before);
    succeed({"info", "w"});
}

TEST_F(WorldCommand, CutsByTheNumberOfProbes) {
    const Json one = run_json({"world", "v.probes", "-o", "one"});
    EXPECT_EQ(one["tiles"], 1);
    const Json many = run_json({"world", "v.probes", "--tile-probes", "50", "-o", "many"});
    const double tiles = many["tiles"];
    const double wanted = one["probes"].get<double>() / 50.0;
    EXPECT_GT(tiles, 0.2 * wanted);
    EXPECT_LE(tiles, wanted);
}

TEST_F(WorldCommand, RefusesWhatIsNotOne) {
    std::filesystem::create_directory(path("folder"));
    write("folder/own.txt", "mine");
    EXPECT_TRUE(contains(fail({"world", "v.probes", "-o", "folder"}), "not a world"));
    EXPECT_EQ(read("folder/own.txt"), "mine");
    EXPECT_TRUE(contains(fail({"world", "v.probes", "-o", "v.probes"}), "is not a folder"));
    write("five.json", R"({"groups": [{"name": "flat", "positions": [[0,0,0],[1,0,0],[0,1,0]]}]})");
    succeed({"tetrahedralize", "five.json", "-o", "flat.probes"});
    EXPECT_TRUE(contains(fail({"world", "flat.probes", "-o", "w"}), "without tetrahedra"));
    succeed({"world", "v.probes", "-o", "w"});
    EXPECT_TRUE(contains(fail({"query", "w", "--normals"}, "0 0 0 0 1 0\n"), "without normals"));
    EXPECT_TRUE(contains(fail({"info", "w", "--probes"}), "is a world"));
}

}  // namespace
}  // namespace tetralight::test
