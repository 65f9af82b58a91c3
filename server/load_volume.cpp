// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/load_volume.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include <tetralight/base/process/descriptor_io.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/file_ids.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

/// Why a volume whose bytes do not have its id cannot be used: what is wrong with them if opening
/// it tells that.
Error changed(const std::string& path, const Result<ProbeFile>& file) {
    if (!file && file.error().code == ErrorCode::Corrupt) return file.error();
    return {ErrorCode::Corrupt, path + ": its bytes have changed"};
}

/// The bytes from which a file is mapped.
std::span<const std::byte> mapped_bytes(const ProbeFile& file) {
    const std::byte* begin = nullptr;
    uint64_t size = 0;
    for (const ProbeFile::Section& section : file.sections()) {
        const auto bytes = file.section_bytes(section.name, section.element_size);
        if (!bytes || bytes->empty()) continue;
        begin = bytes->data() - section.offset;
        size = std::max(size, section.offset + section.size);
    }
    return {begin, size};
}

Result<LoadedVolume> map_volume(const std::string& path, const std::string& id) {
    Descriptor opened(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    const auto stamp = opened ? stamp_of(opened) : std::nullopt;
    if (!stamp) return system_error(path, "open");
    const auto ids = read_file_ids(path);
    if (!ids) return ids.error();
    const ThreadGuard reading;
    auto file = open_probe_file(path);
    if (!ids->contains(id) || reading.is_damaged()) return changed(path, file);
    if (!file) return file.error();
    auto guard = MapGuard::make(mapped_bytes(*file));
    if (!guard) return guard.error();
    return LoadedVolume{std::move(*file), ids->bytes,       std::move(*guard), path,
                        *stamp,           std::move(opened)};
}

Result<LoadedVolume> copy_volume(const std::string& path, const std::string& id) {
    const Descriptor copy(::memfd_create("volume", MFD_CLOEXEC));
    if (!copy) return system_error("make a file in memory");
    if (auto status = copy_file(path, copy); !status) return status.error();
    const std::string name = path_of_descriptor(copy);
    const auto ids = read_file_ids(name);
    if (!ids) return ids.error();
    auto file = open_probe_file(name);
    if (file && ids->contains(id)) return LoadedVolume{std::move(*file), ids->bytes};
    Error error = ids->contains(id) ? file.error() : changed(name, file);
    error.message = path + ": " + reason_without_path(error, name);
    return error;
}

}  // namespace

bool LoadedVolume::is_whole() const {
    return is_copy() || (!is_damaged() && !has_changed(stamp_of(opened)));
}

void LoadedVolume::require_whole() const {
    if (is_whole()) return;
    throw Problem{503, "unavailable", "the volume's file changed while it was read"};
}

Result<LoadedVolume> load_volume(const std::string& path, const std::string& id,
                                 uint64_t copy_limit) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0) return system_error(path, "open");
    return static_cast<uint64_t>(status.st_size) <= copy_limit ? copy_volume(path, id)
                                                               : map_volume(path, id);
}

}  // namespace tetralight::server
