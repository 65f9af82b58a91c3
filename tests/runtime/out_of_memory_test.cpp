// SPDX-License-Identifier: Apache-2.0
// The C API in a process that may have no more memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>
#include <tetralight/runtime/tetralight.h>
#include "tests/support/property_volume.h"
#include "tests/support/temp_folder.h"

// Sanitizers need address space of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TETRALIGHT_SKIP_LIMITS GTEST_SKIP() << "the sanitizer needs memory without a limit"
#else
#define TETRALIGHT_SKIP_LIMITS
#endif

namespace tetralight {
namespace {

/// Takes what the process can get but for pieces below 64 KiB.
void leave_little_memory() {
    size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t bytes = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
    const rlimit limit{bytes, bytes};
    if (setrlimit(RLIMIT_AS, &limit) != 0) std::abort();
    while (void* volatile piece = std::malloc(65536)) static_cast<void>(piece);
}

/// Ends the child: 0 where the call was refused with `words` in the message.
[[noreturn]] void end_with(tetralight_status status, const tetralight_error& error,
                           const char* words) {
    std::fprintf(stderr, "%d: %s\n", static_cast<int>(status), error.message);
    const bool is_said = std::string_view(error.message).find(words) != std::string_view::npos;
    std::_Exit(status == TETRALIGHT_OUT_OF_MEMORY && is_said ? 0 : 1);
}

/// Large enough that what it needs is no small piece.
class OutOfMemory : public testing::Test {
  protected:
    void SetUp() override {
        TETRALIGHT_SKIP_LIMITS;
        ProbeVolume data = test::make_random_volume(test::random_positions(3000, 1), 2);
        data.layers.resize(1);
        data.layers[0].largest = 10.0f;
        data.layer_names = "sky\n";
        data.transfer.resize(3000);
        data.sky.resize(1);
        data.layer_irradiance = data.irradiance;
        const std::string path = folder.write("test.probes", probe_file_bytes(data.view()));
        ASSERT_EQ(tetralight_open(path.c_str(), &volume, &error), TETRALIGHT_OK) << error.message;
    }

    void TearDown() override { tetralight_close(volume); }

    TempFolder folder;
    tetralight_volume* volume = nullptr;
    tetralight_error error{};
};

using OutOfMemoryDeathTest = OutOfMemory;

TEST_F(OutOfMemoryDeathTest, RecombineIsRefused) {
    const auto child = [&] {
        leave_little_memory();
        const float weight = 0.5f;
        end_with(tetralight_recombine(volume, &weight, 1, &error), error, "324128 bytes");
    };
    EXPECT_EXIT(child(), testing::ExitedWithCode(0), "");  // 3000 x 108 + 128
}

TEST_F(OutOfMemoryDeathTest, RelightIsRefused) {
    const std::vector<float> sky(48, 0.5f);
    const auto child = [&] {
        leave_little_memory();
        end_with(tetralight_relight_sky(volume, sky.data(), &error), error,
                 "no memory for a copy of the volume: ");
    };
    EXPECT_EXIT(child(), testing::ExitedWithCode(0), "");
}

TEST_F(OutOfMemoryDeathTest, SaveIsRefused) {
    const std::string path = folder.write("old.probes", "old");
    const auto child = [&] {
        leave_little_memory();
        end_with(tetralight_save(volume, path.c_str(), &error), error,
                 "no memory for a block of the file: 1048576 bytes");
    };
    EXPECT_EXIT(child(), testing::ExitedWithCode(0), "");
    EXPECT_EQ(std::filesystem::file_size(path), 3u);
}

TEST_F(OutOfMemoryDeathTest, CopiesOfFilesAreRefused) {
    const std::vector<std::byte> bytes(1'000'000);
    const auto child = [&] {
        leave_little_memory();
        tetralight_volume* opened = nullptr;
        end_with(tetralight_open_memory(bytes.data(), bytes.size(), &opened, &error), error,
                 "no memory for a copy of the file: 1000000 bytes");
    };
    EXPECT_EXIT(child(), testing::ExitedWithCode(0), "");
}

TEST_F(OutOfMemoryDeathTest, ShaderVolumesAreRefused) {
    const auto child = [&] {
        leave_little_memory();
        tetralight_shader_volume* made = nullptr;
        end_with(tetralight_make_shader_volume(volume, &made, &error), error,
                 "no memory for a shader volume: ");
    };
    EXPECT_EXIT(child(), testing::ExitedWithCode(0), "");
}

TEST_F(OutOfMemoryDeathTest, ProxyVolumesAreRefused) {
    tetralight_lppv_box box{};
    for (int i = 0; i < 4; ++i) box.world_from_box[5 * i] = 1.0f;
    for (float& x : box.high) x = 1.0f;
    for (uint32_t& x : box.resolution) x = 64;
    tetralight_lppv_size size{};
    ASSERT_EQ(tetralight_get_lppv_size(&box, &size, &error), TETRALIGHT_OK);
    const std::unique_ptr<std::byte[]> texels(new std::byte[size.bytes]);
    const auto child = [&] {
        leave_little_memory();
        const tetralight_array array{texels.get(), size.bytes, 0};
        tetralight_lppv_constants constants{};
        end_with(tetralight_fill_lppv(volume, &box, &array, &constants, &error), error,
                 "no memory for a proxy volume: ");
    };
    EXPECT_EXIT(child(), testing::ExitedWithCode(0), "");
}

TEST_F(OutOfMemoryDeathTest, QueriesNeedNone) {
    std::vector<float> positions(3 * 5000, 0.1f), occlusion(4 * 5000);
    tetralight_batch batch{};
    batch.count = 5000;
    batch.positions = {positions.data(), 4 * positions.size(), 0};
    batch.occlusion = {occlusion.data(), 4 * occlusion.size(), 0};
    const auto child = [&] {
        leave_little_memory();
        const auto status = tetralight_query_batch(volume, &batch, nullptr, &error);
        std::_Exit(status == TETRALIGHT_OK ? 0 : 1);
    };
    EXPECT_EXIT(child(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace tetralight
