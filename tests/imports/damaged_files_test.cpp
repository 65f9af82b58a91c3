// SPDX-License-Identifier: Apache-2.0
// The files of tests/imports/files, cut off and changed: they are read, or refused by an error that
// names the file.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include <tetralight/base/file.h>
#include <tetralight/probes/is_finite.h>
#include "tests/imports/import_case.h"

namespace tetralight {
namespace {

std::string read_sample(const std::string& name) {
    const auto bytes = read_file(std::string(TETRALIGHT_IMPORT_FILES "/") + name);
    EXPECT_TRUE(bytes) << error_text(bytes.error());
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
}

class DamagedFiles : public testing::TestWithParam<const char*> {
  protected:
    /// Holds that a text is read to sound groups, or refused. True if it is read.
    bool is_read(std::string_view text) {
        const std::string path = folder_.write(GetParam(), text);
        const auto imported = import_groups(path);
        if (!imported) {
            const std::string message = error_text(imported.error());
            EXPECT_EQ(message.find(path + ":"), 0u) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            return false;
        }
        std::set<std::string> names;
        for (const ProbeGroup& group : imported->groups) {
            EXPECT_FALSE(group.name.empty());
            EXPECT_TRUE(names.insert(group.name).second) << group.name;
            for (const glm::dvec3& position : group.positions) EXPECT_TRUE(is_finite(position));
        }
        return true;
    }

  private:
    TempFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(All, DamagedFiles,
                         testing::Values("probes.csv", "level.tscn", "level.unity"),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             std::ranges::replace(name, '.', '_');
                             return name;
                         });

TEST_P(DamagedFiles, WholeFilesAreRead) {
    EXPECT_TRUE(is_read(read_sample(GetParam())));
}

TEST_P(DamagedFiles, CutOffAnywhereAreReadOrRefused) {
    const std::string text = read_sample(GetParam());
    size_t refused = 0;
    for (size_t length = 0; length < text.size(); ++length)
        refused += is_read(std::string_view(text).substr(0, length)) ? 0 : 1;
    EXPECT_GT(refused, 10u);
}

TEST_P(DamagedFiles, WithAnyByteChangedAreReadOrRefused) {
    const std::string text = read_sample(GetParam());
    size_t refused = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        for (const int change : {0x01, 0x04, 0x40, 0x80}) {
            std::string damaged = text;
            damaged[i] = static_cast<char>(damaged[i] ^ change);
            refused += is_read(damaged) ? 0 : 1;
        }
    }
    EXPECT_GT(refused, text.size());  // the highest bit alone breaks UTF-8
}

TEST_P(DamagedFiles, WithAnyLineLeftOutOrTwiceAreReadOrRefused) {
    const std::string text = read_sample(GetParam());
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = text.find('\n', begin) + 1;
        is_read(text.substr(0, begin) + text.substr(end));
        is_read(text.substr(0, end) + text.substr(begin));
        begin = end;
    }
}

}  // namespace
}  // namespace tetralight
