// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include <tetralight/base/file.h>

namespace tetralight {

/// An empty folder of one test, removed at its end.
class TempFolder {
  public:
    TempFolder() {
        std::string name = testing::TempDir() + "tetralight.XXXXXX";
        path_ = ::mkdtemp(name.data());
    }

    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    ~TempFolder() { std::filesystem::remove_all(path_); }

    [[nodiscard]] std::string path(const std::string& name) const { return path_ + "/" + name; }

    /// Writes a file and returns its path.
    std::string write(const std::string& name, std::span<const std::byte> bytes) const {
        // Not write_file(): it waits for the disk, and some tests write thousands of files.
        std::ofstream file(path(name), std::ios::binary);
        file.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        EXPECT_TRUE(file.flush());
        return path(name);
    }

    std::string write(const std::string& name, std::string_view text) const {
        return write(name, std::as_bytes(std::span(text)));
    }

  private:
    std::string path_;
};

}  // namespace tetralight
