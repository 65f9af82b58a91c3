// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_chunks.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include <tetralight/base/descriptor.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/probes/content_hash.h>

namespace tetralight {
namespace {

/// So many chunks at most; each begins with a ray tree of its own.
constexpr uint32_t kMostChunks = 64;
constexpr uint32_t kLeastProbes = 16;
constexpr uint64_t kMagic = 0x31'4b'4e'55'48'43'4c'54;  // "TLCHUNK1"

struct ChunkHeader {
    uint64_t magic = kMagic;
    uint64_t key = 0;
    uint64_t hash = 0;  ///< of the rest of the header, accumulators and rows
    uint32_t begin = 0;
    uint32_t end = 0;
    uint64_t row_size = 0;
};

static_assert(sizeof(ChunkHeader) == 40);

uint64_t hash_of(ChunkHeader header, std::span<const std::byte> accumulators,
                 std::span<const std::byte> rows) {
    header.hash = 0;
    ContentHash hash;
    hash.add(header);
    hash.add_bytes(accumulators);
    hash.add_bytes(rows);
    return hash.value();
}

/// A bake of all probes whose chunks lie in a folder.
class ChunkFolder {
  public:
    ChunkFolder(std::string path, const PreparedBake& prepared, RangeBake& bake)
        : path_(std::move(path)),
          key_(prepared.key),
          probe_count_(static_cast<uint32_t>(prepared.capture_positions.size())),
          row_size_(LightGroupLayout(prepared.settings.bake.plan).size()),
          bake_(bake) {}

    /// Takes all chunks that are of this bake; one flag a probe.
    std::vector<bool> read() {
        std::vector<bool> is_done(probe_count_, false);
        std::error_code error;
        for (const auto& entry : std::filesystem::directory_iterator(path_, error)) {
            if (entry.path().extension() != ".chunk") continue;
            const auto range = read_chunk(entry.path().string());
            if (!range) {
                std::filesystem::remove(entry.path(), error);
                continue;
            }
            std::fill(is_done.begin() + range->begin, is_done.begin() + range->end, true);
        }
        return is_done;
    }

    [[nodiscard]] Status write(const ProbeRange& range) const {
        const auto accumulators = std::as_bytes(
            std::span(bake_.partial.accumulators).subspan(range.begin, range.count()));
        const auto rows =
            std::as_bytes(std::span(bake_.partial.split_rows)
                              .subspan(range.begin * row_size_, range.count() * row_size_));
        ChunkHeader header{
            .key = key_, .begin = range.begin, .end = range.end, .row_size = row_size_};
        header.hash = hash_of(header, accumulators, rows);
        const std::span<const std::byte> parts[] = {std::as_bytes(std::span(&header, 1)),
                                                    accumulators, rows};
        const std::string path =
            str_cat(path_, "/", range.begin, "-", range.end, "-of-", probe_count_, ".chunk");
        if (auto status = write_file(path, parts); !status) return status;
        const Descriptor folder(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        if (!folder || ::fsync(folder.value()) != 0) return system_error(path_, "sync");
        return Ok{};
    }

  private:
    /// Nothing: it is torn, damaged or of another bake.
    std::optional<ProbeRange> read_chunk(const std::string& path) {
        const auto bytes = read_file(path);
        ChunkHeader header;
        if (!bytes || bytes->size() < sizeof header) return std::nullopt;
        std::memcpy(&header, bytes->data(), sizeof header);
        const bool is_ours = header.magic == kMagic && header.key == key_ &&
                             header.row_size == row_size_ && header.begin < header.end &&
                             header.end <= probe_count_;
        if (!is_ours) return std::nullopt;
        const ProbeRange range{header.begin, header.end};
        const size_t tally_bytes = range.count() * sizeof(ProbeAccumulator);
        const size_t row_bytes = range.count() * row_size_ * sizeof(double);
        if (bytes->size() != sizeof header + tally_bytes + row_bytes) return std::nullopt;
        const auto accumulators = std::span(*bytes).subspan(sizeof header, tally_bytes);
        const auto rows = std::span(*bytes).subspan(sizeof header + tally_bytes);
        if (hash_of(header, accumulators, rows) != header.hash) return std::nullopt;
        std::memcpy(bake_.partial.accumulators.data() + range.begin, accumulators.data(),
                    tally_bytes);
        if (row_bytes > 0) {
            std::memcpy(bake_.partial.split_rows.data() + range.begin * row_size_, rows.data(),
                        row_bytes);
        }
        return range;
    }

    std::string path_;
    uint64_t key_;
    uint32_t probe_count_;
    size_t row_size_;
    RangeBake& bake_;
};

/// The next probes without light, at most `size`.
ProbeRange next_range(const std::vector<bool>& is_done, uint32_t from, uint32_t size) {
    const auto count = static_cast<uint32_t>(is_done.size());
    while (from < count && is_done[from]) ++from;
    uint32_t end = from;
    while (end < count && end - from < size && !is_done[end]) ++end;
    return {from, end};
}

}  // namespace

Result<RangeBake> bake_in_chunks(const Scene& scene, const PreparedBake& prepared,
                                 const std::string& folder, const BakeCallback& callback) {
    const auto count = static_cast<uint32_t>(prepared.capture_positions.size());
    const size_t row_size = LightGroupLayout(prepared.settings.bake.plan).size();
    RangeBake bake;
    bake.partial = {{0, count},
                    std::vector<ProbeAccumulator>(count),
                    true,
                    std::vector<double>(count * row_size)};
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return Error{folder + ": cannot make the folder (" + error.message() + ")"};

    ChunkFolder chunks(folder, prepared, bake);
    const std::vector<bool> is_done = chunks.read();
    for (const ProbeAccumulator& accumulator : bake.partial.accumulators)
        bake.earlier_ray_count += accumulator.ray_count;
    auto done_count = static_cast<size_t>(std::ranges::count(is_done, true));
    uint64_t ray_count = 0;
    const uint32_t size = std::max(kLeastProbes, (count + kMostChunks - 1) / kMostChunks);
    for (ProbeRange range = next_range(is_done, 0, size); range.count() > 0;
         range = next_range(is_done, range.end, size)) {
        BakeProgress last;
        const auto report = [&](const BakeProgress& progress) {
            last = progress;
            last.fraction_done =
                (static_cast<double>(done_count) + progress.fraction_done * range.count()) / count;
            last.probes_done += done_count;
            last.probe_count = count;
            last.ray_count += ray_count;
            return !callback || callback(last);
        };
        auto baked = bake_range(scene, prepared, range, {}, report);
        if (!baked) return baked.error();
        const PartialBake& part = baked->partial;
        std::ranges::copy(part.accumulators, bake.partial.accumulators.begin() + range.begin);
        std::ranges::copy(part.split_rows, bake.partial.split_rows.begin() +
                                               static_cast<ptrdiff_t>(range.begin * row_size));
        if (auto status = chunks.write(range); !status) return status.error();
        done_count += range.count();
        ray_count = last.ray_count;
    }
    return bake;
}

}  // namespace tetralight
