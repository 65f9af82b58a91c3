// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tests/support/temp_folder.h"

namespace tetralight::test {

/// Programs that behave as badly as a test wants: shell scripts in a folder of their own.
class FakePrograms {
  public:
    /// A program of these shell commands; returns its path.
    std::string script(const std::string& name, const std::string& commands) const {
        const std::string path = folder_.write(name, "#!/bin/sh\n" + commands + "\n");
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path;
    }

    /// A program that writes these bytes, and then runs more commands.
    std::string writer(const std::string& name, std::span<const std::byte> bytes,
                       const std::string& commands = "") const {
        folder_.write(name + ".bytes", bytes);
        return script(name, "cat \"$0.bytes\"\n" + commands);
    }

    [[nodiscard]] std::string path(const std::string& name) const { return folder_.path(name); }

    std::string write(const std::string& name, std::string_view text) const {
        return folder_.write(name, text);
    }

  private:
    TempFolder folder_;
};

}  // namespace tetralight::test
