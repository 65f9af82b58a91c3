// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/probe_shading.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace tetralight {
namespace {

glm::vec3 random_normal(std::mt19937_64& engine) {
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(engine), normal(engine), normal(engine)));
}

IrradianceSh random_irradiance(std::mt19937_64& engine) {
    std::uniform_real_distribution<float> value(-1.0f, 2.0f);
    IrradianceSh sh;
    for (glm::vec3& c : sh.coefficients) c = {value(engine), value(engine), value(engine)};
    return sh;
}

void expect_near(glm::vec3 a, glm::vec3 b, float tolerance) {
    EXPECT_LE(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(ProbeShading, TwoBandsAreTheLightWithoutItsThird) {
    std::mt19937_64 engine(1);
    for (int i = 0; i < 1000; ++i) {
        IrradianceSh sh = random_irradiance(engine);
        const PackedSh4 bands = first_bands(pack_sh(sh));
        for (int k = 4; k < kShCoefficientCount; ++k) sh.coefficients[k] = glm::vec3(0.0f);
        const glm::vec3 normal = random_normal(engine);
        expect_near(sample_sh4(bands, normal), sample_sh9(pack_sh(sh), normal), 1e-6f);
    }
}

TEST(ProbeShading, LayersAddUpAsTheirLightDoes) {
    std::mt19937_64 engine(2);
    const IrradianceSh base = random_irradiance(engine), lamp = random_irradiance(engine);
    const glm::vec3 weight(0.0f, 0.5f, 2.0f);
    IrradianceSh sum = base;
    for (int k = 0; k < kShCoefficientCount; ++k) {
        sum.coefficients[k] += weight * lamp.coefficients[k];
    }
    const PackedSh added = add_layer(pack_sh(base), pack_sh(lamp), weight);
    const glm::vec3 normal = random_normal(engine);
    expect_near(sample_sh9(added, normal), sample_sh9(pack_sh(sum), normal), 1e-6f);
    EXPECT_EQ(added.shc.w, 1.0f);
}

TEST(ProbeShading, ALightWithoutAChannelIsNotOccluded) {
    const glm::vec4 occlusion(0.1f, 0.2f, 0.3f, 0.4f);
    for (int channel = 0; channel < 4; ++channel) {
        EXPECT_EQ(probe_occlusion(occlusion, channel), occlusion[channel]);
    }
    for (const int channel : {-1, -100, 4, 1000}) {
        EXPECT_EQ(probe_occlusion(occlusion, channel), 1.0f);
    }
}

TEST(ProbeShading, BeyondTheShadowMapProbesAloneSayWhatIsLit) {
    EXPECT_EQ(mix_occlusion(0.0f, 0.75f, 1.0f), 0.75f);
    EXPECT_EQ(mix_occlusion(0.25f, 0.75f, 0.0f), 0.25f);
    EXPECT_EQ(mix_occlusion(1.0f, 0.75f, 0.0f), 0.75f);
}

TEST(ProbeShading, NormalsOfScaledAndMirroredInstancesStandOnTheirSurface) {
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<float> size(0.2f, 5.0f), angle(0.0f, 6.0f);
    for (int i = 0; i < 1000; ++i) {
        glm::mat4 world = glm::rotate(glm::mat4(1.0f), angle(engine), random_normal(engine));
        const glm::vec3 mirror(i & 1 ? -1 : 1, i & 2 ? -1 : 1, i & 4 ? -1 : 1);
        world = glm::scale(world, mirror * glm::vec3(size(engine), size(engine), size(engine)));
        const glm::vec3 normal = random_normal(engine);
        const glm::vec3 turned = instance_normal(world[0], world[1], world[2], normal);
        expect_near(turned, glm::normalize(glm::inverseTranspose(glm::mat3(world)) * normal),
                    1e-5f);
        // Outwards: a step along the normal stays a step away from the surface.
        EXPECT_GT(glm::dot(turned, glm::mat3(world) * normal), 0.0f);
    }
}

TEST(ProbeShading, NormalsOfInstancesHoldForEveryScaleThatIsPromised) {
    const glm::vec3 normal = glm::normalize(glm::vec3(1, 2, 3));
    for (const float scale : {1e-9f, 1e-4f, 1e9f}) {
        const glm::vec3 x(-scale, 0, 0), y(0, scale, 0), z(0, 0, scale);
        expect_near(instance_normal(x, y, z, normal), normal * glm::vec3(-1, 1, 1), 1e-6f);
    }
}

TEST(ProbeShading, AnInstanceWithoutAVolumeKeepsItsNormal) {
    const glm::vec3 normal(0.0f, 0.6f, 0.8f), none(0.0f);
    EXPECT_EQ(instance_normal(none, none, none, normal), normal);
}

TEST(ProbeShading, TheDominantLightOfOneSunIsThatSun) {
    // A delta of irradiance E in direction d: L_1m = E Y_1m(d).
    const glm::vec3 to_sun = glm::normalize(glm::vec3(1, 2, -0.5)), irradiance(3, 2, 1);
    RadianceSh sun;
    const auto basis = sh_basis(to_sun);
    for (int i = 0; i < kShCoefficientCount; ++i) sun.coefficients[i] = irradiance * basis[i];
    const PackedSh sh = pack_sh(irradiance_from_radiance(sun));
    expect_near(dominant_direction(sh), to_sun, 1e-5f);
    expect_near(dominant_irradiance(sh, to_sun), irradiance, 1e-4f);
    expect_near(dominant_irradiance(sh, -to_sun), glm::vec3(0.0f), 1e-6f);
}

TEST(ProbeShading, EvenLightHasSomeDirectionAndNoDominantIrradiance) {
    const PackedSh sh = pack_sh(irradiance_from_radiance(constant_radiance(glm::vec3(1.0f))));
    EXPECT_NEAR(glm::length(dominant_direction(sh)), 1.0f, 1e-6f);
    expect_near(dominant_irradiance(sh, dominant_direction(sh)), glm::vec3(0.0f), 1e-6f);
}

TEST(ProbeShading, SpecularReflectionMirrorsNoMoreThanArrives) {
    // Its mean over the directions of light is the share that is mirrored: below 1, near to it for
    // a smooth white metal, whose facets hide little, and for roughness 1, seen straight on, the
    // integral of 1/π · 2c/(c + 1) / 4 over the half sphere, c the cosine: 1 − ln 2.
    std::mt19937_64 engine(1);
    const glm::vec3 normal(0, 0, 1);
    const auto share_of = [&](float roughness, glm::vec3 to_eye) {
        constexpr int kCount = 400'000;
        double sum = 0.0;
        for (int i = 0; i < kCount; ++i) {
            glm::vec3 to_light = random_normal(engine);
            to_light.z = std::abs(to_light.z);
            sum += static_cast<double>(
                specular_reflection(normal, to_light, to_eye, glm::vec3(1.0f), roughness).x);
        }
        return sum / kCount * 2.0 * 3.14159265;
    };
    const double smooth = share_of(0.3f, glm::normalize(glm::vec3(0.5f, 0, 1)));
    EXPECT_LT(smooth, 1.02);
    EXPECT_GT(smooth, 0.95);
    EXPECT_NEAR(share_of(1.0f, normal), 1.0 - std::log(2.0), 0.005);
}

TEST(ProbeShading, SpecularReflectionIsReciprocalButForTheCosine) {
    const glm::vec3 normal(0, 0, 1), a = glm::normalize(glm::vec3(0.5f, 0.2f, 1)),
                                     b = glm::normalize(glm::vec3(-0.9f, 0.1f, 0.4f));
    const glm::vec3 f0(0.04f);
    expect_near(specular_reflection(normal, a, b, f0, 0.5f) / a.z,
                specular_reflection(normal, b, a, f0, 0.5f) / b.z, 1e-5f);
    expect_near(specular_reflection(normal, -a, b, f0, 0.5f), glm::vec3(0.0f), 0.0f);
}

}  // namespace
}  // namespace tetralight
