// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/read_gltf.h>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Unwrap : public CommandFixture {
  protected:
    [[nodiscard]] static Arguments arguments(const std::string& output, const Arguments& more = {},
                                             const std::string& scene = kCourtyard) {
        Arguments all{"unwrap", scene,         "-o", output, "--texels-per-meter",
                      "2",      "--page-size", "256"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

TEST_F(Unwrap, WritesTheSameTrianglesWithUvs) {
    const Json json = run_json(arguments("uv1.glb"));
    EXPECT_EQ(json["pages"], 1);
    EXPECT_GT(json["charts"], 40);
    EXPECT_EQ(json["warnings"], 0);
    const auto before = read_gltf(kCourtyard);
    const auto after = read_gltf(path("uv1.glb"));
    ASSERT_TRUE(before && after);
    ASSERT_EQ(after->instances.size(), before->instances.size());
    for (size_t i = 0; i < after->instances.size(); ++i) {
        const MeshInstance& now = after->instances[i];
        const Mesh& a = before->meshes[before->instances[i].mesh];
        const Mesh& b = after->meshes[now.mesh];
        EXPECT_EQ(now.world_from_mesh, before->instances[i].world_from_mesh);
        ASSERT_EQ(a.indices.size(), b.indices.size());
        for (size_t k = 0; k < a.indices.size(); ++k)
            EXPECT_EQ(a.positions[a.indices[k]], b.positions[b.indices[k]]);
    }
    EXPECT_EQ(after->lights.size(), before->lights.size());
    EXPECT_EQ(after->materials, before->materials);
}

TEST_F(Unwrap, WrittenUvsDoNotOverlap) {
    succeed(arguments("uv1.glb"));
    EXPECT_EQ(run_json(arguments("again.glb", {"--uvs", "keep"}, "uv1.glb"))["warnings"], 0);
    succeed({"lightmap", "uv1.glb", "-o", "c.lightmaps", "-t", "2", "--page-size", "256", "-s", "1",
             "--uvs", "keep"});
    succeed({"export", "c.lightmaps", "--scene", "uv1.glb", "-o", "lit.glb"});
}

TEST_F(Unwrap, RefusesScenesWithoutObjectsAndItsOwnInput) {
    write("empty.gltf", kEmptyScene);
    EXPECT_TRUE(contains(fail(arguments("x.glb", {}, "empty.gltf")),
                         "empty.gltf: the scene has no object that takes a lightmap"));
    succeed(arguments("uv1.glb"));
    EXPECT_TRUE(contains(fail_and_keep("uv1.glb", arguments("uv1.glb", {}, "uv1.glb")),
                         "is an input of this command"));
}

}  // namespace
}  // namespace tetralight::test
