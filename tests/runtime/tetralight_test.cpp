// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/tetralight.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/runtime/shader_volume.h>
#include "tests/runtime/c_api_consumer.h"
#include "tests/runtime/shader_query_cases.h"
#include "tests/support/property_volume.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// A volume in a file, open through the C API.
class CApi : public testing::Test {
  protected:
    CApi() {
        data = test::make_random_volume(test::random_positions(300, 1), 2);
        data.occlusion.assign(data.positions.size(), glm::vec4(0.5f, 1.0f, 0.0f, 1.0f));
        path = folder.write("test.probes", probe_file_bytes(data.view()));
        EXPECT_EQ(tetralight_open(path.c_str(), &volume, &error), TETRALIGHT_OK) << error.message;
    }

    ~CApi() override { tetralight_close(volume); }

    CApi(const CApi&) = delete;
    CApi& operator=(const CApi&) = delete;

    TempFolder folder;
    ProbeVolume data;
    std::string path;
    tetralight_volume* volume = nullptr;
    tetralight_error error{};
};

TEST_F(CApi, ServesAConsumerInC) {
    EXPECT_EQ(run_c_api_consumer(path.c_str()), 0);
}

TEST_F(CApi, AnswersWhatTheLibraryAnswers) {
    const float position[] = {0.1f, 0.2f, -0.3f};
    tetralight_light light{};
    uint32_t hint = TETRALIGHT_NO_CELL;
    ASSERT_EQ(tetralight_query(volume, position, &hint, &light, &error), TETRALIGHT_OK);
    const CellLocation location = locate(data.view(), {0.1f, 0.2f, -0.3f});
    const InterpolatedProbe probe = interpolate(data.view(), location);
    const PackedSh packed = pack_sh(probe.irradiance);
    EXPECT_EQ(hint, location.cell);
    EXPECT_EQ(light.cell, location.cell);
    EXPECT_EQ(std::memcmp(light.packed, &packed, sizeof packed), 0);
    EXPECT_EQ(std::memcmp(light.weights, &location.weights, sizeof light.weights), 0);
    EXPECT_EQ(light.occlusion[0], probe.occlusion.x);
}

TEST_F(CApi, APositionThatIsNotFiniteGetsAmbientLightAndNoCell) {
    const float position[] = {NAN, 0.0f, 0.0f};
    tetralight_light light{};
    uint32_t hint = 7;
    ASSERT_EQ(tetralight_query(volume, position, &hint, &light, nullptr), TETRALIGHT_OK);
    EXPECT_EQ(light.cell, TETRALIGHT_NO_CELL);
    EXPECT_EQ(hint, TETRALIGHT_NO_CELL) << "as a batch says it";
    EXPECT_EQ(light.occlusion[2], 1.0f);
}

TEST_F(CApi, SaysWhatAVolumeHolds) {
    tetralight_info info{};
    ASSERT_EQ(tetralight_get_info(volume, &info, &error), TETRALIGHT_OK);
    EXPECT_EQ(info.probe_count, data.positions.size());
    EXPECT_EQ(info.cell_count, data.cells.size());
    EXPECT_EQ(info.inner_cell_count, data.info.inner_cell_count);
    EXPECT_EQ(info.dimension, 4u);
    EXPECT_EQ(info.has_light, 1u);
    EXPECT_EQ(info.has_occlusion, 1u);
}

TEST_F(CApi, FilesThatAreNotThereOrBrokenAreErrors) {
    tetralight_volume* other = nullptr;
    EXPECT_EQ(tetralight_open("/no/such.probes", &other, &error), TETRALIGHT_BAD_FILE);
    EXPECT_NE(std::string(error.message).find("/no/such.probes"), std::string::npos);
    EXPECT_EQ(other, nullptr);
    auto bytes = probe_file_bytes(data.view());
    bytes[bytes.size() - 5] ^= std::byte{1};
    const std::string broken = folder.write("broken.probes", bytes);
    EXPECT_EQ(tetralight_open(broken.c_str(), &other, &error), TETRALIGHT_CORRUPT);
    ASSERT_EQ(tetralight_open_lazy(broken.c_str(), &other, &error), TETRALIGHT_OK);
    EXPECT_EQ(tetralight_verify(other, &error), TETRALIGHT_CORRUPT);
    EXPECT_GT(std::strlen(error.message), 10u);
    tetralight_close(other);
    EXPECT_EQ(tetralight_verify(volume, &error), TETRALIGHT_OK);
}

TEST_F(CApi, OpensACopyOfAFileInMemory) {
    std::vector<std::byte> bytes = probe_file_bytes(data.view());
    tetralight_volume* other = nullptr;
    ASSERT_EQ(tetralight_open_memory(bytes.data(), bytes.size(), &other, &error), TETRALIGHT_OK)
        << error.message;
    bytes.assign(bytes.size(), std::byte{0xff});
    const float position[] = {0.1f, 0.2f, -0.3f};
    tetralight_light light{}, expected{};
    EXPECT_EQ(tetralight_query(other, position, nullptr, &light, &error), TETRALIGHT_OK);
    EXPECT_EQ(tetralight_query(volume, position, nullptr, &expected, &error), TETRALIGHT_OK);
    EXPECT_EQ(std::memcmp(&light, &expected, sizeof light), 0);
    EXPECT_EQ(tetralight_verify(other, &error), TETRALIGHT_OK) << error.message;
    tetralight_close(other);
}

TEST_F(CApi, FilesInMemoryThatAreWrongAreErrors) {
    std::vector<std::byte> bytes = probe_file_bytes(data.view());
    tetralight_volume* other = nullptr;
    EXPECT_EQ(tetralight_open_memory(nullptr, 10, &other, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_STREQ(error.message, "bytes is NULL");
    EXPECT_EQ(tetralight_open_memory(bytes.data(), bytes.size(), nullptr, &error),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_open_memory(bytes.data(), 0, &other, &error), TETRALIGHT_CORRUPT);
    EXPECT_EQ(tetralight_open_memory(bytes.data(), bytes.size() - 1, &other, &error),
              TETRALIGHT_CORRUPT);
    bytes[bytes.size() - 5] ^= std::byte{1};
    EXPECT_EQ(tetralight_open_memory(bytes.data(), bytes.size(), &other, &error),
              TETRALIGHT_CORRUPT);
    EXPECT_EQ(std::string(error.message).find("memory: "), 0u) << error.message;
    EXPECT_EQ(other, nullptr);
}

TEST_F(CApi, NullPointersAreErrors) {
    const float floats[28] = {};
    float out[28];
    tetralight_light light;
    tetralight_volume* other = nullptr;
    tetralight_info info;
    tetralight_batch batch{};
    tetralight_instances instances{};
    tetralight_shader_volume* made = nullptr;
    tetralight_const_array array;
    EXPECT_EQ(tetralight_open(nullptr, &other, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_open(path.c_str(), nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_open_lazy(nullptr, nullptr, nullptr), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_verify(nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_get_info(nullptr, &info, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_get_info(volume, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_query(nullptr, floats, nullptr, &light, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_query(volume, nullptr, nullptr, &light, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_query(volume, floats, nullptr, nullptr, nullptr), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_query_batch(nullptr, &batch, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_query_batch(volume, nullptr, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_pack_instances(nullptr, &instances, nullptr, &error),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_pack_instances(volume, nullptr, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_pack_sh(nullptr, out, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_pack_sh(floats, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_sample_sh9(nullptr, floats, out, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_sample_sh9(floats, nullptr, out, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_sample_sh9(floats, floats, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_make_shader_volume(nullptr, &made, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_make_shader_volume(volume, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_get_shader_array(nullptr, 0, &array, &error), TETRALIGHT_BAD_POINTER);
    tetralight_close(nullptr);
    tetralight_free_shader_volume(nullptr);
}

/// A batch of floats in memory of its own size, so that sanitizers see what lies beyond.
struct CBatch {
    std::vector<float> positions = std::vector<float>(30, 0.1f);
    std::vector<float> sh = std::vector<float>(280, -7.0f);
    std::vector<float> occlusion = std::vector<float>(40, -7.0f);
    std::vector<uint32_t> hints = std::vector<uint32_t>(10, TETRALIGHT_NO_CELL);
    tetralight_batch batch{};

    CBatch() {
        batch.count = 10;
        batch.positions = {positions.data(), positions.size() * 4, 0};
        batch.sh = {sh.data(), sh.size() * 4, 0};
        batch.sh_format = TETRALIGHT_SH_PACKED;
        batch.occlusion = {occlusion.data(), occlusion.size() * 4, 0};
        batch.hints = {hints.data(), hints.size() * 4, 0};
    }

    [[nodiscard]] bool is_untouched() const {
        return sh == std::vector<float>(280, -7.0f) && occlusion == std::vector<float>(40, -7.0f) &&
               hints == std::vector<uint32_t>(10, TETRALIGHT_NO_CELL);
    }
};

using Spoil = void (*)(tetralight_batch&);

struct BadBatch {
    const char* name;
    tetralight_status status;
    const char* message;
    Spoil spoil;
};

class CApiBadBatch : public CApi, public testing::WithParamInterface<BadBatch> {};

TEST_P(CApiBadBatch, IsAnErrorThatWritesNothing) {
    CBatch good;
    GetParam().spoil(good.batch);
    EXPECT_EQ(tetralight_query_batch(volume, &good.batch, nullptr, &error), GetParam().status);
    EXPECT_STREQ(error.message, GetParam().message);
    EXPECT_TRUE(good.is_untouched());
}

std::byte* odd(void* data) {
    return static_cast<std::byte*>(data) + 1;
}

constexpr size_t kHuge = std::numeric_limits<size_t>::max();

const BadBatch kBadBatches[] = {
    {"NoPositions", TETRALIGHT_BAD_POINTER, "positions is NULL",
     [](tetralight_batch& b) { b.positions.data = nullptr; }},
    {"NoOutput", TETRALIGHT_BAD_POINTER, "sh and occlusion are both NULL",
     [](tetralight_batch& b) { b.sh.data = b.occlusion.data = nullptr; }},
    {"OddPointer", TETRALIGHT_BAD_POINTER, "occlusion is not aligned to 4 bytes",
     [](tetralight_batch& b) { b.occlusion.data = odd(b.occlusion.data); }},
    {"SmallStride", TETRALIGHT_BAD_VALUE, "positions has a stride of 8 bytes, and elements of 12",
     [](tetralight_batch& b) { b.positions.stride = 8; }},
    {"OddStride", TETRALIGHT_BAD_VALUE, "sh has a stride of 114 bytes, and elements of 112",
     [](tetralight_batch& b) { b.sh.stride = 114; }},
    {"HintsWithGaps", TETRALIGHT_BAD_VALUE, "hints has a stride of 8 bytes, and elements of 4",
     [](tetralight_batch& b) { b.hints.stride = 8; }},
    {"ShortPositions", TETRALIGHT_SHORT_BUFFER,
     "positions is 116 bytes long, too short for 10 elements of 12 bytes, 12 bytes apart",
     [](tetralight_batch& b) { b.positions.size -= 4; }},
    {"ShortSh", TETRALIGHT_SHORT_BUFFER,
     "sh is 1119 bytes long, too short for 10 elements of 112 bytes, 112 bytes apart",
     [](tetralight_batch& b) { b.sh.size -= 1; }},
    {"ShortOcclusion", TETRALIGHT_SHORT_BUFFER,
     "occlusion is 3 bytes long, too short for 10 elements of 16 bytes, 16 bytes apart",
     [](tetralight_batch& b) { b.occlusion.size = 3; }},
    {"ShortHints", TETRALIGHT_SHORT_BUFFER,
     "hints is 0 bytes long, too short for 10 elements of 4 bytes, 4 bytes apart",
     [](tetralight_batch& b) { b.hints.size = 0; }},
    {"HugeCount", TETRALIGHT_SHORT_BUFFER,
     "positions is 120 bytes long, too short for 18446744073709551615 elements of 12 bytes, 12 "
     "bytes apart",
     [](tetralight_batch& b) { b.count = kHuge; }},
    {"HugeStride", TETRALIGHT_SHORT_BUFFER,
     "sh is 1120 bytes long, too short for 10 elements of 112 bytes, 18446744073709551612 bytes "
     "apart",
     [](tetralight_batch& b) { b.sh.stride = kHuge - 3; }},
    {"Format", TETRALIGHT_BAD_VALUE, "sh_format is out of range: 3",
     [](tetralight_batch& b) { b.sh_format = 3; }},
    {"Outside", TETRALIGHT_BAD_VALUE, "outside is out of range: 77",
     [](tetralight_batch& b) { b.outside = 77; }},
    {"Walls", TETRALIGHT_BAD_VALUE, "walls is out of range: 2",
     [](tetralight_batch& b) { b.walls = 2; }},
    {"Fade", TETRALIGHT_BAD_VALUE, "fade_distance is not positive and finite: 0",
     [](tetralight_batch& b) { b.outside = TETRALIGHT_AMBIENT; }},
    {"FadeNan", TETRALIGHT_BAD_VALUE, "fade_distance is not positive and finite: nan",
     [](tetralight_batch& b) {
         b.outside = TETRALIGHT_AMBIENT;
         b.fade_distance = NAN;
     }},
};

INSTANTIATE_TEST_SUITE_P(Kinds, CApiBadBatch, testing::ValuesIn(kBadBatches),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST_F(CApi, WallsHideProbesInEveryQueryUnlessABatchIgnoresThem) {
    test::ShaderQueryVolume subject({"random", 300});
    subject.add_random_walls();
    const ProbeVolumeView view = subject.volume.view();
    const std::string walled_path = folder.write("walled.probes", probe_file_bytes(view));
    tetralight_volume* walled = nullptr;
    ASSERT_EQ(tetralight_open(walled_path.c_str(), &walled, &error), TETRALIGHT_OK);
    const std::vector<glm::vec3> positions = subject.make_positions(100);
    std::vector<PackedSh> light(positions.size());
    tetralight_batch batch{};
    batch.count = positions.size();
    batch.positions = {positions.data(), sizeof(glm::vec3) * positions.size(), 0};
    batch.sh = {light.data(), sizeof(PackedSh) * light.size(), 0};
    batch.sh_format = TETRALIGHT_SH_PACKED;
    for (const Walls walls : {Walls::HideProbes, Walls::Ignore}) {
        batch.walls = static_cast<uint32_t>(walls);
        EXPECT_EQ(tetralight_query_batch(walled, &batch, nullptr, &error), TETRALIGHT_OK);
        for (size_t i = 0; i < positions.size(); ++i) {
            const auto probe = interpolate(view, locate(view, positions[i]), {walls});
            EXPECT_EQ(light[i], pack_sh(probe.irradiance));
            if (walls == Walls::Ignore) continue;
            tetralight_light single{};
            tetralight_query(walled, &positions[i].x, nullptr, &single, &error);
            EXPECT_EQ(std::memcmp(single.packed, &light[i], sizeof light[i]), 0);
        }
    }
    tetralight_close(walled);
}

TEST_F(CApi, BatchesAndInstancesSayWhatIsLit) {
    test::ShaderQueryVolume subject({"random", 300});
    subject.add_random_walls();
    for (size_t i = 0; i < subject.volume.positions.size(); ++i) {
        subject.volume.rendering_layers.push_back(i % 2 == 0 ? 0b01 : 0b10);
    }
    const ProbeVolumeView view = subject.volume.view();
    const std::string layered_path = folder.write("layers.probes", probe_file_bytes(view));
    tetralight_volume* layered = nullptr;
    ASSERT_EQ(tetralight_open(layered_path.c_str(), &layered, &error), TETRALIGHT_OK);
    const size_t count = 3000;  // more than a block
    const std::vector<glm::vec3> positions = subject.make_positions(count);
    std::vector<uint32_t> layers(count);
    std::vector<float> radii(count);
    std::vector<glm::vec3> normals(count, glm::vec3(0, 1, 0));
    for (size_t i = 0; i < count; ++i) {
        layers[i] = static_cast<uint32_t>(i % 4);
        radii[i] = 0.1f * static_cast<float>(i % 3);
    }
    std::vector<PackedSh> light(count), expected(count);
    tetralight_batch batch{};
    batch.count = count;
    batch.positions = {positions.data(), sizeof(glm::vec3) * count, 0};
    batch.sh = {light.data(), sizeof(PackedSh) * count, 0};
    batch.sh_format = TETRALIGHT_SH_PACKED;
    batch.rendering_layers = {layers.data(), sizeof(uint32_t) * count, 0};
    batch.radii = {radii.data(), sizeof(float) * count, 0};
    batch.normals = {normals.data(), sizeof(glm::vec3) * count, 0};
    batch.normal_offset = TETRALIGHT_NORMAL_OFFSET;
    EXPECT_EQ(tetralight_query_batch(layered, &batch, nullptr, &error), TETRALIGHT_OK);
    ASSERT_TRUE(interpolate(view, {.positions = positions,
                                   .irradiance = expected,
                                   .rendering_layers = layers,
                                   .radii = radii,
                                   .normals = normals}));
    EXPECT_EQ(light, expected);

    std::vector<glm::vec4> sh[7];
    tetralight_instances instances{};
    instances.count = count;
    instances.positions = batch.positions;
    instances.rendering_layers = batch.rendering_layers;
    instances.radii = batch.radii;
    for (size_t i = 0; i < 7; ++i) {
        sh[i].resize(count);
        instances.sh[i] = {sh[i].data(), sizeof(glm::vec4) * count, 0};
    }
    EXPECT_EQ(tetralight_pack_instances(layered, &instances, nullptr, &error), TETRALIGHT_OK);
    ASSERT_TRUE(interpolate(view, {.positions = positions,
                                   .irradiance = expected,
                                   .rendering_layers = layers,
                                   .radii = radii}));
    for (size_t i = 0; i < count; ++i) EXPECT_EQ(sh[0][i], expected[i].sha_r);

    batch.normal_offset = -1.0f;
    EXPECT_EQ(tetralight_query_batch(layered, &batch, nullptr, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_STREQ(error.message, "normal_offset is -1; it must be finite and not negative");
    radii[2000] = NAN;
    EXPECT_EQ(tetralight_query_batch(layered, &batch, nullptr, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_STREQ(error.message, "radii[2000] is nan; it must be finite and not negative");
    instances.walls = 2;
    EXPECT_EQ(tetralight_pack_instances(layered, &instances, nullptr, &error),
              TETRALIGHT_BAD_VALUE);
    instances.walls = TETRALIGHT_IGNORE_WALLS;
    instances.radii = {};
    instances.rendering_layers.size -= 4;
    EXPECT_EQ(tetralight_pack_instances(layered, &instances, nullptr, &error),
              TETRALIGHT_SHORT_BUFFER);
    tetralight_close(layered);
}

TEST_F(CApi, AnEmptyBatchNeedsNoBuffers) {
    tetralight_batch batch{};
    tetralight_report report{9, 9};
    EXPECT_EQ(tetralight_query_batch(volume, &batch, &report, &error), TETRALIGHT_OK);
    EXPECT_EQ(report.step_count, 0u);
    tetralight_instances instances{};
    EXPECT_EQ(tetralight_pack_instances(volume, &instances, nullptr, &error), TETRALIGHT_OK);
}

TEST_F(CApi, AMillionStridedPositionsAnswerAsThoseWithoutGaps) {
    constexpr size_t kCount = 1'000'000;
    std::vector<glm::vec4> apart(kCount);
    std::vector<glm::vec3> joined(kCount);
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<float> coordinate(-1.5f, 1.5f);
    for (size_t i = 0; i < kCount; ++i) {
        joined[i] = {coordinate(engine), coordinate(engine), coordinate(engine)};
        apart[i] = glm::vec4(joined[i], NAN);
    }
    std::vector<glm::vec4> first(kCount), second(kCount);
    tetralight_batch batch{};
    batch.count = kCount;
    batch.positions = {apart.data(), 16 * kCount, 16};
    batch.occlusion = {first.data(), 16 * kCount, 0};
    tetralight_report report{};
    ASSERT_EQ(tetralight_query_batch(volume, &batch, &report, &error), TETRALIGHT_OK);
    EXPECT_EQ(report.not_finite_count, 0u);
    batch.positions = {joined.data(), 12 * kCount, 0};
    batch.occlusion.data = second.data();
    ASSERT_EQ(tetralight_query_batch(volume, &batch, &report, &error), TETRALIGHT_OK);
    for (size_t i = 0; i < kCount; ++i) ASSERT_LE(glm::distance(first[i], second[i]), 1e-5f);
}

TEST_F(CApi, InstancesAreCheckedArrayByArray) {
    std::vector<float> positions(30), sh(40);
    tetralight_instances instances{};
    instances.count = 10;
    instances.positions = {positions.data(), 120, 0};
    for (tetralight_array& array : instances.sh) array = {sh.data(), 160, 0};
    EXPECT_EQ(tetralight_pack_instances(volume, &instances, nullptr, &error), TETRALIGHT_OK);
    instances.sh[4].size = 159;
    EXPECT_EQ(tetralight_pack_instances(volume, &instances, nullptr, &error),
              TETRALIGHT_SHORT_BUFFER);
    EXPECT_EQ(std::string(error.message).substr(0, 5), "sh[4]");
    instances.sh[4] = {nullptr, 160, 0};
    EXPECT_EQ(tetralight_pack_instances(volume, &instances, nullptr, &error),
              TETRALIGHT_BAD_POINTER);
    instances.sh[4] = {sh.data(), 160, 32};
    EXPECT_EQ(tetralight_pack_instances(volume, &instances, nullptr, &error), TETRALIGHT_BAD_VALUE);
}

TEST_F(CApi, VolumesOfEveryDimensionAndWithoutLightAnswer) {
    std::vector<std::vector<glm::dvec3>> sets(5);
    for (int i = 0; i < 6; ++i) {
        const double t = i;
        sets[1] = {{1, 2, 3}};
        sets[2].emplace_back(t, 2 * t, 0);
        sets[3].emplace_back(t, t * t, 1);
        sets[4].emplace_back(t, t * t, t * t * t);
    }
    for (uint32_t dimension = 0; dimension < sets.size(); ++dimension) {
        ProbeVolume flat = test::make_random_volume(sets[dimension], 1);
        if (dimension % 2 == 1) flat.irradiance.clear();
        const std::string flat_path = folder.write("flat.probes", probe_file_bytes(flat.view()));
        tetralight_volume* opened = nullptr;
        ASSERT_EQ(tetralight_open(flat_path.c_str(), &opened, &error), TETRALIGHT_OK)
            << error.message;
        tetralight_info info{};
        ASSERT_EQ(tetralight_get_info(opened, &info, &error), TETRALIGHT_OK);
        EXPECT_EQ(info.dimension, dimension);
        EXPECT_EQ(info.has_occlusion, 0u);
        const float position[] = {0.5f, 7.0f, -1.0f};
        tetralight_light light{};
        EXPECT_EQ(tetralight_query(opened, position, nullptr, &light, &error), TETRALIGHT_OK);
        EXPECT_TRUE(std::isfinite(light.packed[3]));
        EXPECT_EQ(light.occlusion[0], 1.0f);
        tetralight_close(opened);
    }
}

TEST_F(CApi, APathThatIsVeryLongLeavesRoomForTheReason) {
    tetralight_volume* other = nullptr;
    const std::string long_path = "/no/" + std::string(3000, 'x');
    EXPECT_EQ(tetralight_open(long_path.c_str(), &other, &error), TETRALIGHT_BAD_FILE);
    EXPECT_TRUE(
        std::string_view(error.message).ends_with("x: cannot open (No such file or directory)"))
        << error.message;
}

TEST_F(CApi, ASuccessEmptiesTheMessage) {
    tetralight_info info{};
    error.message[0] = 'x';
    EXPECT_EQ(tetralight_get_info(volume, &info, &error), TETRALIGHT_OK);
    EXPECT_STREQ(error.message, "");
}

TEST_F(CApi, OddPointersAreErrors) {
    alignas(16) std::byte memory[8192] = {};
    const auto odd = [&]<class Type>(Type*) { return reinterpret_cast<Type*>(memory + 1); };
    const float floats[28] = {};
    float out[28];
    tetralight_light light;
    tetralight_batch batch{};
    tetralight_instances instances{};
    tetralight_shader_volume* made = nullptr;
    const auto expect_odd = [&](tetralight_status status, const char* message) {
        EXPECT_EQ(status, TETRALIGHT_BAD_POINTER) << message;
        EXPECT_STREQ(error.message, message);
    };
    expect_odd(tetralight_open(path.c_str(), odd(&volume), &error),
               "volume is not aligned to 8 bytes");
    expect_odd(tetralight_get_info(volume, odd((tetralight_info*)nullptr), &error),
               "info is not aligned to 4 bytes");
    expect_odd(tetralight_get_layer(volume, 0, odd((tetralight_layer*)nullptr), &error),
               "layer is not aligned to 4 bytes");
    expect_odd(tetralight_query(volume, odd(floats), nullptr, &light, &error),
               "position is not aligned to 4 bytes");
    expect_odd(tetralight_query(volume, floats, odd((uint32_t*)nullptr), &light, &error),
               "hint is not aligned to 4 bytes");
    expect_odd(tetralight_query(volume, floats, nullptr, odd(&light), &error),
               "light is not aligned to 4 bytes");
    expect_odd(tetralight_query_batch(volume, odd(&batch), nullptr, &error),
               "batch is not aligned to 8 bytes");
    expect_odd(tetralight_query_batch(volume, &batch, odd((tetralight_report*)nullptr), &error),
               "report is not aligned to 8 bytes");
    expect_odd(tetralight_pack_instances(volume, odd(&instances), nullptr, &error),
               "instances is not aligned to 8 bytes");
    expect_odd(tetralight_pack_sh(floats, odd(out), &error), "packed is not aligned to 4 bytes");
    expect_odd(tetralight_make_shader_volume(volume, odd(&made), &error),
               "made is not aligned to 8 bytes");
}

TEST_F(CApi, NumbersThatAreNotFiniteAreNoLight) {
    float numbers[28] = {}, out[28] = {}, normal[] = {0.0f, 1.0f, 0.0f};
    EXPECT_EQ(tetralight_pack_sh(numbers, out, &error), TETRALIGHT_OK);
    EXPECT_EQ(tetralight_sample_sh9(numbers, normal, out, &error), TETRALIGHT_OK);
    out[0] = -7.0f;
    numbers[26] = NAN;
    EXPECT_EQ(tetralight_pack_sh(numbers, out, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_STREQ(error.message, "coefficients[26] is not finite: nan");
    EXPECT_EQ(tetralight_sample_sh9(numbers, normal, out, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_STREQ(error.message, "packed[26] is not finite: nan");
    numbers[26] = 0.0f;
    normal[1] = -INFINITY;
    EXPECT_EQ(tetralight_sample_sh9(numbers, normal, out, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_STREQ(error.message, "normal[1] is not finite: -inf");
    EXPECT_EQ(out[0], -7.0f);
}

TEST_F(CApi, ShaderArraysAreThoseOfTheLibrary) {
    tetralight_shader_volume* made = nullptr;
    ASSERT_EQ(tetralight_make_shader_volume(volume, &made, &error), TETRALIGHT_OK);
    const ShaderVolume expected = make_shader_volume(data.view());
    tetralight_const_array array{};
    ASSERT_EQ(tetralight_get_shader_array(made, 0, &array, &error), TETRALIGHT_OK);
    EXPECT_EQ(array.size, sizeof expected.constants);
    EXPECT_EQ(std::memcmp(array.data, &expected.constants, array.size), 0);
    ASSERT_EQ(tetralight_get_shader_array(made, 2, &array, &error), TETRALIGHT_OK);
    ASSERT_EQ(array.size, expected.light.size() * sizeof(PackedProbe));
    EXPECT_EQ(std::memcmp(array.data, expected.light.data(), array.size), 0);
    for (uint32_t i = 0; i < TETRALIGHT_SHADER_ARRAY_COUNT; ++i) {
        ASSERT_EQ(tetralight_get_shader_array(made, i, &array, &error), TETRALIGHT_OK);
        EXPECT_GE(array.size, 16u);
    }
    EXPECT_EQ(tetralight_get_shader_array(made, TETRALIGHT_SHADER_ARRAY_COUNT, &array, &error),
              TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(tetralight_get_shader_array(made, 0, nullptr, &error), TETRALIGHT_BAD_POINTER);
    tetralight_free_shader_volume(made);
}

TEST_F(CApi, QueriesOfManyThreadsAgree) {
    CBatch expected;
    ASSERT_EQ(tetralight_query_batch(volume, &expected.batch, nullptr, &error), TETRALIGHT_OK);
    std::vector<CBatch> batches(4);
    std::vector<std::jthread> threads;
    for (CBatch& each : batches) {
        threads.emplace_back([&] {
            for (int i = 0; i < 50; ++i) {
                EXPECT_EQ(tetralight_query_batch(volume, &each.batch, nullptr, nullptr),
                          TETRALIGHT_OK);
            }
        });
    }
    threads.clear();
    for (const CBatch& each : batches) EXPECT_EQ(each.sh, expected.sh);
}

}  // namespace
}  // namespace tetralight
