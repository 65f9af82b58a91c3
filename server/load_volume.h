// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tetralight/base/process/descriptor.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/server/file_stamp.h>
#include <tetralight/server/map_guard.h>

namespace tetralight::server {

/// A verified volume in memory.
struct LoadedVolume {
    ProbeFile file;
    uint64_t bytes = 0;
    /// Of a volume that is mapped; a copy needs none, as nothing can change it.
    std::optional<MapGuard> guard = {};
    /// Of a volume that is mapped: its file, and what it was before it was verified.
    std::string path = {};
    FileStamp stamp = {};
    /// The same file, also when it was moved to the quarantine or deleted in the meantime.
    Descriptor opened = Descriptor();

    [[nodiscard]] bool is_copy() const { return !guard; }

    /// True if its file became unreadable: answers that it gave are wrong.
    [[nodiscard]] bool is_damaged() const { return guard && guard->is_damaged(); }

    /// True if the bytes of its file may have changed since they were verified; `now` is its stamp.
    /// A file that is gone keeps its bytes while it is mapped.
    [[nodiscard]] bool has_changed(const std::optional<FileStamp>& now) const {
        return !is_copy() && now && !now->has_same_bytes(stamp);
    }

    /// False if it is damaged or may have changed.
    [[nodiscard]] bool is_whole() const;

    /// Throws a `Problem`, 503, unless it is whole. Call it before an answer is sent.
    void require_whole() const;
};

/// Opens a volume whose bytes must have an id, and verifies all of it. One of at most `copy_limit`
/// bytes is copied, so that nothing that happens to its file changes its light. A larger one is
/// mapped. Returns corrupt if its bytes do not have the id or are no volume, and otherwise the
/// reason why it cannot be read.
[[nodiscard]] Result<LoadedVolume> load_volume(const std::string& path, const std::string& id,
                                               uint64_t copy_limit);

}  // namespace tetralight::server
