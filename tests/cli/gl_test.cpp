// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "tests/cli/command_fixture.h"
#include "tests/cli/picture.h"

namespace tetralight::test {
namespace {

class Gl : public CommandFixture {
  protected:
    Gl() { bake_courtyard("v.probes"); }

    [[nodiscard]] static Arguments with(Arguments all, const Arguments& more) {
        const Arguments size{"--width",     "32", "--height",   "24",
                             "--antialias", "1",  "--exposure", "1"};
        all.insert(all.end(), size.begin(), size.end());
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    [[nodiscard]] static Arguments render(const Arguments& more) {
        return with({"render", kCourtyard, "v.probes", "-o", "p.png"}, more);
    }

    [[nodiscard]] static Arguments meshball(const Arguments& more) {
        return with({"meshball", "v.probes", "-o", "p.png", "--count", "60"}, more);
    }

    [[nodiscard]] static Arguments join(Arguments all, const Arguments& more) {
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    /// Mean difference of two pictures, of 255.
    [[nodiscard]] double difference(const Arguments& first, const Arguments& second) const {
        succeed(first);
        const auto a = decode_picture(read("p.png"));
        succeed(second);
        const auto b = decode_picture(read("p.png"));
        EXPECT_TRUE(a && b);
        double sum = 0.0;
        for (size_t i = 0; i < a->pixels.size(); ++i) {
            for (size_t k = 0; k < 3; ++k) sum += std::abs(a->pixels[i][k] - b->pixels[i][k]);
        }
        return sum / (3.0 * static_cast<double>(a->pixels.size()));
    }

    /// Whether this machine has OpenGL.
    [[nodiscard]] bool has_gl() const {
        return !contains(succeed(render({"--renderer", "gl"})).err, "rendering on the CPU");
    }
};

TEST_F(Gl, DrawsWhatRaysShow) {
    if (!has_gl()) GTEST_SKIP() << "no OpenGL";
    EXPECT_LT(difference(render({"--renderer", "gl"}), render({})), 5.0);
    EXPECT_LT(difference(meshball({"--renderer", "gl"}), meshball({})), 5.0);
}

TEST_F(Gl, MirrorsReflectionProbesAsRaysDo) {
    if (!has_gl()) GTEST_SKIP() << "no OpenGL";
    succeed({"reflect", kCourtyard, "--box", "-9,0,-9,9,6,9", "-o", "r.ktx2", "--cube-size", "8",
             "-s", "4"});
    const Arguments mirror{"--reflections", "r.ktx2"};
    EXPECT_LT(difference(join(render({"--renderer", "gl"}), mirror), render(mirror)), 5.0);
    const Arguments metal{"--reflections", "r.ktx2", "--roughness", "0.3"};
    EXPECT_LT(difference(join(meshball({"--renderer", "gl"}), metal), meshball(metal)), 5.0);
    EXPECT_GT(difference(meshball(metal), meshball({})), 5.0);
}

TEST_F(Gl, ShowsGizmosAsRaysDo) {
    if (!has_gl()) GTEST_SKIP() << "no OpenGL";
    const Arguments shown{"--show", "probes,cells,selection=0,1,8,lppv"};
    EXPECT_LT(difference(join(render({"--renderer", "gl"}), shown), render(shown)), 6.0);
    EXPECT_GT(difference(render(shown), render({})), 5.0);
}

TEST_F(Gl, WithoutOpenGlItSaysSoAndTakesTheCpu) {
    succeed(render({}));
    const std::string by_cpu = read("p.png");
    ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/none.json", 1);
    const auto rendered = succeed(render({"--renderer", "gl"}));
    const std::string picture = read("p.png");
    const auto ball = succeed(meshball({"--renderer", "gl"}));
    ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    EXPECT_TRUE(contains(rendered.err, "warning: OpenGL: ")) << rendered.err;
    EXPECT_TRUE(contains(rendered.err, "; rendering on the CPU")) << rendered.err;
    EXPECT_TRUE(picture == by_cpu);
    EXPECT_TRUE(contains(ball.err, "; rendering on the CPU")) << ball.err;
}

TEST_F(Gl, TakesTheCpuForPicturesThatAreTooLarge) {
    if (!has_gl()) GTEST_SKIP() << "no OpenGL";
    const std::string said =
        succeed({"meshball", "v.probes", "-o", "p.png", "--count", "1", "--renderer", "gl",
                 "--width", "16384", "--height", "2", "--antialias", "16"})
            .err;
    EXPECT_TRUE(contains(said, "131072 including those for antialiasing; rendering on the CPU"))
        << said;
}

TEST_F(Gl, SaysThatADriverIsSoftware) {
    const std::string mesa = "/usr/share/glvnd/egl_vendor.d/50_mesa.json";
    ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", mesa.c_str(), 1);
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    const bool is_there = std::filesystem::exists(mesa) && has_gl();
    const std::string by_gl = succeed(render({"--renderer", "gl"})).err;
    ::unsetenv("LIBGL_ALWAYS_SOFTWARE");
    ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    if (!is_there) GTEST_SKIP() << "no software OpenGL";
    EXPECT_TRUE(contains(by_gl, "warning: OpenGL runs in software, llvmpipe (")) << by_gl;
    EXPECT_EQ(std::ranges::count(by_gl, '\n'), 1) << by_gl;
}

TEST_F(Gl, LightsTheBallInThreeWays) {
    for (const std::string renderer : {"cpu", "gl"}) {
        const Arguments plain = meshball({"--renderer", renderer});
        EXPECT_GT(difference(plain, join(plain, {"--off"})), 2.0) << renderer;
        const double lppv = difference(plain, join(plain, {"--lppv"}));
        EXPECT_LT(lppv, 4.0) << renderer;
        EXPECT_GT(lppv, 0.0) << renderer;
        EXPECT_GT(difference(plain, join(plain, {"--specular"})), 0.0) << renderer;
    }
    EXPECT_TRUE(contains(misuse(meshball({"--lppv", "--off"})), "--off"));
}

TEST_F(Gl, WritesASequenceInWhichTheBallTurns) {
    for (const std::string renderer : {"cpu", "gl"}) {
        EXPECT_EQ(run_json(meshball({"--frames", "2", "--renderer", renderer}))["frames"], 2);
        EXPECT_TRUE(read("p_0000.png") != read("p_0001.png")) << renderer;
    }
}

TEST_F(Gl, NamesWhatItCannotShow) {
    EXPECT_TRUE(contains(misuse(render({"--show", "probes,ghosts"})), "\"ghosts\""));
    EXPECT_TRUE(contains(misuse(render({"--show", "selection=1,2"})), "three numbers"));
    EXPECT_TRUE(contains(misuse(render({"--show", "selection=1,2,x"})), "three numbers"));
    EXPECT_TRUE(
        contains(misuse(render({"--show", "selection=1,2,nan"})), "\"nan\" is not a number"));
    EXPECT_TRUE(contains(misuse(render({"--show", "selection=1e30,2,3"})), "1e30 is not in"));
}

TEST_F(Gl, AWindowNeedsAScreen) {
    ::setenv("DISPLAY", ":987", 1);
    const std::string message = fail({"meshball", "v.probes", "--window"});
    ::unsetenv("DISPLAY");
    EXPECT_TRUE(contains(message, "OpenGL: no screen for a window")) << message;
}

}  // namespace
}  // namespace tetralight::test
