// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tetralight::test {

/// Input that every command has to refuse.
struct BadFile {
    std::string name;
    std::string bytes;
    /// What the message has to say.
    std::string reason;
};

/// glTF that is cut off, no glTF at all, or points at what is not there.
[[nodiscard]] std::vector<BadFile> bad_scenes(const std::string& sound_glb);

/// Probe-group files and glTF scenes whose groups cannot be used.
[[nodiscard]] std::vector<BadFile> bad_groups();

/// Probe volumes that are cut off, damaged or something else.
[[nodiscard]] std::vector<BadFile> bad_volumes(const std::string& sound_volume);

}  // namespace tetralight::test
