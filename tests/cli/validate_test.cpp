// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <vector>

#include <tetralight/probes/build/make_seeds.h>
#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/probe_file.h>
#include "tests/cli/command_fixture.h"
#include "tests/support/random_probes.h"

namespace tetralight::test {
namespace {

class Validate : public CommandFixture {
  protected:
    /// The report on a volume that is not valid.
    [[nodiscard]] Json report_on(const ProbeVolume& volume) const {
        const auto bytes = probe_file_bytes(volume.view());  // write_probe_file() would refuse it
        write("bad.probes", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        const CommandResult result = run({"validate", "bad.probes", "--json"});
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_EQ(result.err.find("tetralight: bad.probes: "), 0u) << result.err;
        Json json = Json::parse(result.out, nullptr, false);
        EXPECT_EQ(json["is_valid"], false);
        EXPECT_GE(json["problems"].size(), 1u);
        return json;
    }
};

/// Two tetrahedra, one over and one under a triangle.
ProbeVolume two_tetrahedra() {
    return test::make_lit_volume({{1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, 2}, {0, 0, -2}});
}

void turn(Cell& cell) {
    std::swap(cell.vertices[0], cell.vertices[1]);
    std::swap(cell.neighbors[0], cell.neighbors[1]);
}

/// Something that a sound structure can have wrong, and the counter that tells.
struct Corruption {
    const char* counter;
    void (*apply)(ProbeVolume& volume);
};

const Corruption kCorruptions[] = {
    {"inverted_cells", [](ProbeVolume& v) { turn(v.cells[0]); }},
    {"non_delaunay_faces",
     [](ProbeVolume& v) {
         for (glm::dvec3& p : v.exact_positions) p.z *= 0.1;
     }},
    {"concave_hull_edges",
     [](ProbeVolume& v) {
         for (size_t i = v.info.inner_cell_count; i < v.cells.size(); ++i) turn(v.cells[i]);
     }},
    {"inward_hull_rays",
     [](ProbeVolume& v) {
         for (HullCellRays& cell : v.hull_rays) {
             for (glm::vec3& ray : cell.rays) ray = -ray;
         }
     }},
    {"torn_hull_rays",
     [](ProbeVolume& v) {
         glm::vec3& ray = v.hull_rays[0].rays[0];
         ray = glm::normalize(ray + glm::vec3(0.01f, 0.02f, -0.01f));
     }},
    {"probes_without_cell",
     [](ProbeVolume& v) {
         v.positions.emplace_back(0.0f);
         v.exact_positions.emplace_back(0.0);
         v.irradiance.emplace_back();
         v.sources.push_back({0, 5, 5});
     }},
    {"probes_without_source", [](ProbeVolume& v) { v.sources.pop_back(); }},
    {"misplaced_float_probes", [](ProbeVolume& v) { v.positions[2].y += 0.01f; }},
    {"wrong_compact_probes",
     [](ProbeVolume& v) {
         make_compact_probes(v);
         v.irradiance[3].coefficients[4].y += 0.01f * v.info.compact_scale * 4096.0f;
     }},
    {"torn_edges",
     [](ProbeVolume& v) {
         const ProbeEdges edges(v.view());
         store_visibility(edges, std::vector<uint8_t>(edges.size(), 100), v);
         ++v.cell_visibility[0].codes[0];
     }},
    {"wrong_layer_sums", [](ProbeVolume& v) {
         v.layers.resize(2);
         v.layer_names = "sun\nsky\n";
         v.layers[0].weight = 1.001f;  // 1 when the light was added up
         v.layers[0].largest = largest_coefficient(v.irradiance);
         v.layer_irradiance = v.irradiance;
         v.layer_irradiance.resize(2 * v.irradiance.size());
     }}};

/// Something that no query could use, and the section that is to blame.
const Corruption kUnusable[] = {
    {"info",
     [](ProbeVolume& v) { v.info.world_origin.x = std::numeric_limits<double>::infinity(); }},
    {"positions", [](ProbeVolume& v) { v.positions[1].z = NAN; }},
    {"irradiance", [](ProbeVolume& v) { v.irradiance.pop_back(); }},
    {"occlusion", [](ProbeVolume& v) { v.occlusion.assign(5, glm::vec4(2.0f)); }},
    {"validity", [](ProbeVolume& v) { v.validity.assign(5, -1.0f); }},
    {"cells", [](ProbeVolume& v) { v.cells[0].vertices[0] = 1000; }},
    {"cells", [](ProbeVolume& v) { std::swap(v.cells[0], v.cells[1]); }},
    {"hull_rays", [](ProbeVolume& v) { v.hull_rays[0].rays[0] *= 2.0f; }},
    {"seeds",
     [](ProbeVolume& v) {
         make_seeds(v);
         v.seeds.at(0).cell = 1000;
     }},
    {"exact_positions", [](ProbeVolume& v) { v.exact_positions[0].x = NAN; }},
    {"sources", [](ProbeVolume& v) { v.sources[0].group = 7; }},
    {"info", [](ProbeVolume& v) { v.info.dimension = Dimension::Plane; }},
    {"info", [](ProbeVolume& v) { v.info.dimension = static_cast<Dimension>(9); }},
    {"info", [](ProbeVolume& v) { v.info.seed_cube.scale = -1.0; }},
    {"seeds",
     [](ProbeVolume& v) {
         make_seeds(v);
         v.seeds.insert(v.seeds.begin(), {1ull << 63, 0, 0});
     }},
    {"visibility_blocks", [](ProbeVolume& v) { v.visibility_blocks.resize(2); }},
    {"cell_visibility",
     [](ProbeVolume& v) {
         v.visibility_blocks.resize(1);
         v.cell_visibility.resize(1);
     }},
    {"group_names", [](ProbeVolume& v) { v.group_names.pop_back(); }},
    {"group_names", [](ProbeVolume& v) { v.group_names = "a\xff\n"; }},
    {"group_names", [](ProbeVolume& v) { v.group_names = "b\na\n"; }},
    {"group_names", [](ProbeVolume& v) { v.group_names = "a\na\n"; }},
    {"metadata", [](ProbeVolume& v) { v.metadata = std::string(200000, '['); }},
    {"metadata", [](ProbeVolume& v) { v.metadata = "\"no object\""; }}};

TEST_F(Validate, FindsABakedVolumeSound) {
    bake_courtyard("v.probes");
    EXPECT_TRUE(contains(succeed({"validate", "v.probes"}).out, "v.probes: valid, 255 probes"));
}

TEST_F(Validate, KeepsToOneLineWhenANameHasTwo) {
    bake_courtyard("two\nlines.probes");
    EXPECT_EQ(
        succeed({"validate", "two\nlines.probes"}).out.find("two\\u000alines.probes: valid, "), 0u);
}

TEST_F(Validate, SaysSoAsJson) {
    bake_courtyard("v.probes");
    const Json json = run_json({"validate", "v.probes"});
    EXPECT_EQ(json["is_valid"], true);
    EXPECT_EQ(json["problems"], Json::array());
    EXPECT_NEAR(json["cell_measure"].get<double>(), json["hull_measure"].get<double>(), 1e-6);
}

TEST_F(Validate, NamesTheSectionOfAFlippedByte) {
    bake_courtyard("v.probes");
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file);
    const std::string sound = read("v.probes");
    for (const ProbeFile::Section& section : file->sections()) {
        std::string damaged = sound;
        damaged[section.offset + section.size / 2] ^= 0x10;
        write("damaged.probes", damaged);
        const std::string message = fail({"validate", "damaged.probes"});
        EXPECT_TRUE(contains(message, "damaged.probes: section \"" + section.name)) << message;
    }
}

TEST_F(Validate, NamesAGeometryProblem) {
    bake_courtyard("v.probes");
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file);
    ProbeVolumeView bent = file->view();
    std::vector<glm::dvec3> exact(bent.exact_positions.begin(), bent.exact_positions.end());
    std::swap(exact[0], exact[1]);
    bent.exact_positions = exact;
    ASSERT_TRUE(write_probe_file(path("bent.probes"), bent));
    const CommandResult result = run({"validate", "bent.probes", "--json"});
    EXPECT_EQ(result.exit_code, 1);
    const Json json = Json::parse(result.out, nullptr, false);
    EXPECT_EQ(json["is_valid"], false);
    EXPECT_GE(json["problems"].size(), 1u);
    EXPECT_EQ(result.err.find("tetralight: bent.probes: "), 0u) << result.err;
}

TEST_F(Validate, CountsEachKindOfProblem) {
    for (const Corruption& corruption : kCorruptions) {
        SCOPED_TRACE(corruption.counter);
        ProbeVolume volume = two_tetrahedra();
        corruption.apply(volume);
        EXPECT_GE(report_on(volume)[corruption.counter], 1);
    }
}

TEST_F(Validate, CountsNothingInASoundVolume) {
    ASSERT_TRUE(write_probe_file(path("v.probes"), two_tetrahedra().view()));
    const Json json = run_json({"validate", "v.probes"});
    for (const Corruption& corruption : kCorruptions) {
        EXPECT_EQ(json[corruption.counter], 0) << corruption.counter;
    }
}

TEST_F(Validate, NamesTheSectionThatNoQueryCouldUse) {
    for (const Corruption& corruption : kUnusable) {
        SCOPED_TRACE(corruption.counter);
        ProbeVolume volume = two_tetrahedra();
        corruption.apply(volume);
        const std::string problem = report_on(volume)["problems"][0];
        EXPECT_TRUE(contains(problem, std::string("section \"") + corruption.counter)) << problem;
    }
}

TEST_F(Validate, SaysOneProblemOfOneThing) {
    ProbeVolume volume = two_tetrahedra();
    turn(volume.cells[0]);
    EXPECT_EQ(report_on(volume)["problems"][0], "1 cell is inverted or has no volume");
}

TEST_F(Validate, SaysAsJsonThatAFileIsDamaged) {
    write("damaged.probes", "TETRAPV");
    const CommandResult result = run({"validate", "damaged.probes", "--json"});
    EXPECT_EQ(result.exit_code, 1);
    const Json json = Json::parse(result.out, nullptr, false);
    EXPECT_EQ(json["is_valid"], false);
    EXPECT_EQ(json["problems"].size(), 1u);
}

TEST_F(Validate, MeasuresUnseenSpaceInAScene) {
    const Json baked = run_json({"bake", kCourtyard, "-o", "v.probes", "-s", "16"});
    EXPECT_FALSE(run_json({"validate", "v.probes"}).contains("unseen"));
    const Json json = run_json({"validate", "v.probes", "--scene", kCourtyard});
    EXPECT_EQ(json["is_valid"], true);
    EXPECT_EQ(json["unseen"], baked["unseen"]);
    const std::string out = succeed({"validate", "v.probes", "--scene", kCourtyard}).out;
    EXPECT_TRUE(contains(out, "of free space sees no probe of its cell")) << out;
    const std::string message = fail({"validate", "v.probes", "--scene", "none.glb"});
    EXPECT_TRUE(contains(message, "none.glb: cannot open")) << message;
}

TEST_F(Validate, RefusesBadVolumes) {
    bake_courtyard("sound.probes");
    refuse_each(bad_volumes(read("sound.probes")), "", [](const std::string& name) {
        return Arguments{"validate", name};
    });
}

TEST_F(Validate, NamesAVolumeThatIsNotThere) {
    EXPECT_TRUE(contains(fail({"validate", "none.probes"}), "none.probes: cannot open"));
}

}  // namespace
}  // namespace tetralight::test
