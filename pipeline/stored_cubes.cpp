// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/stored_cubes.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include <tetralight/base/hash/sha256.h>
#include <tetralight/base/stopwatch.h>

namespace tetralight {
namespace {

/// A cube in a store: this, then the texels of the cube and of each layer.
struct CubeRecord {
    uint64_t ray_count = 0;
    float validity = 1.0f;
    uint32_t reserved = 0;
};

static_assert(sizeof(CubeRecord) == 16 && std::is_trivially_copyable_v<CubeRecord>);

template <class T>
void add(Sha256& hash, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    hash.add(std::as_bytes(std::span(&value, 1)));
}

StoreKey cube_key(const StoreKey& light, const CubeSampling& sampling,
                  const CubePosition& position) {
    Sha256 hash;
    hash.add(std::string_view("cube"));
    hash.add(light);
    add(hash, sampling.size);
    add(hash, sampling.samples_per_texel);
    add(hash, sampling.seed);
    add(hash, sampling.layer_count);
    add(hash, position.position);
    add(hash, position.near_distance);
    return hash.digest();
}

std::vector<std::byte> bytes_of(const BakedCube& cube) {
    std::vector<std::byte> bytes;
    const auto append = [&](std::span<const std::byte> part) {
        bytes.insert(bytes.end(), part.begin(), part.end());
    };
    const CubeRecord record{cube.ray_count, cube.validity};
    append(std::as_bytes(std::span(&record, 1)));
    append(std::as_bytes(std::span(cube.image.texels)));
    for (const CubeImage& layer : cube.layers) append(std::as_bytes(std::span(layer.texels)));
    return bytes;
}

/// None if a value is not that of a cube with finite light.
std::optional<BakedCube> cube_of(std::span<const std::byte> bytes, const CubeSampling& sampling) {
    const size_t count = cube_texel_count(sampling.size), size = count * sizeof(glm::vec3);
    CubeRecord record;
    if (bytes.size() != sizeof record + (1 + size_t{sampling.layer_count}) * size)
        return std::nullopt;
    std::memcpy(&record, bytes.data(), sizeof record);
    if (!(record.validity >= 0.0f && record.validity <= 1.0f)) return std::nullopt;
    BakedCube cube{
        {sampling.size, std::vector<glm::vec3>(count)}, {}, record.validity, record.ray_count};
    cube.layers.resize(sampling.layer_count, cube.image);
    const std::byte* from = bytes.data() + sizeof record;
    for (uint32_t i = 0; i <= sampling.layer_count; ++i, from += size) {
        std::vector<glm::vec3>& texels = i == 0 ? cube.image.texels : cube.layers[i - 1].texels;
        std::memcpy(texels.data(), from, size);
        const bool is_finite = std::ranges::all_of(texels, [](const glm::vec3& light) {
            return std::isfinite(light.r) && std::isfinite(light.g) && std::isfinite(light.b);
        });
        if (!is_finite) return std::nullopt;
    }
    return cube;
}

/// Loads cubes from stores and saves them. Without stores it does nothing.
class CubeKeeper {
  public:
    CubeKeeper(std::vector<StoreKey> keys, const BakeStorage& storage)
        : keys_(std::move(keys)), storage_(storage) {}

    [[nodiscard]] std::optional<BakedCube> load(size_t cube, const CubeSampling& sampling) const {
        for (BakeStore* store : storage_.sources) {
            const auto value = store->find(keys_[cube]);
            auto found = value ? cube_of(*value, sampling) : std::nullopt;
            if (found) return found;
        }
        return std::nullopt;
    }

    /// Keeps a finished cube for the next save, which may be now.
    void add(size_t cube, const BakedCube& baked) {
        if (storage_.target == nullptr) return;
        waiting_.emplace_back(keys_[cube], bytes_of(baked));
        if (since_save_.seconds() >= storage_.save_seconds) save();
    }

    void save() {
        if (storage_.target == nullptr || waiting_.empty()) return;
        std::vector<StoreEntry> entries;
        for (const auto& [key, bytes] : waiting_) entries.push_back({key, bytes});
        const Status saved = storage_.target->put(entries);
        failure_ = saved ? std::nullopt : std::optional(saved.error());
        is_saved_ = is_saved_ || saved;
        if (saved) waiting_.clear();
        since_save_.lap();
    }

    [[nodiscard]] bool must_stop() const { return storage_.is_required && failure_; }

    [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }

    [[nodiscard]] bool is_saved() const { return is_saved_; }

  private:
    std::vector<StoreKey> keys_;
    const BakeStorage& storage_;
    std::vector<std::pair<StoreKey, std::vector<std::byte>>> waiting_;
    Stopwatch since_save_;
    std::optional<Error> failure_;
    bool is_saved_ = false;
};

}  // namespace

Result<StoredCubes> bake_stored_cubes(std::span<const CubePosition> positions,
                                      const CubeSampling& sampling, const SampleCube& sample,
                                      const StoreKey& light, const BakeStorage& storage,
                                      const BakeCallback& callback) {
    std::vector<StoreKey> keys;
    for (const CubePosition& position : positions)
        keys.push_back(cube_key(light, sampling, position));
    CubeKeeper keeper(std::move(keys), storage);
    StoredCubes result;
    result.cubes.resize(positions.size());
    std::vector<size_t> missing;
    std::vector<CubePosition> missing_positions;
    for (size_t i = 0; i < positions.size(); ++i) {
        if (auto found = keeper.load(i, sampling)) {
            result.stored.earlier_ray_count += found->ray_count;
            result.cubes[i] = std::move(*found);
            continue;
        }
        missing.push_back(i);
        missing_positions.push_back(positions[i]);
    }
    const CubeFinished finished = [&](size_t i, const BakedCube& cube) {
        keeper.add(missing[i], cube);
        return !keeper.must_stop();
    };
    const uint64_t known = (positions.size() - missing.size()) * kCubeFaceCount * sampling.size;
    const BakeCallback show = [&](BakeProgress progress) {
        progress.probes_done += known;
        progress.probe_count += known;
        return !callback || callback(progress);
    };
    auto baked = bake_cubes(missing_positions, sampling, sample, show, finished);
    if (!baked || storage.is_saved_at_end) keeper.save();
    if (keeper.must_stop() || (!baked && keeper.failure()))
        return keeper.failure()->in("interrupted; what is done could not be kept");
    if (!baked) return baked.error();
    for (size_t i = 0; i < missing.size(); ++i) result.cubes[missing[i]] = std::move((*baked)[i]);
    result.stored.is_saved = keeper.is_saved();
    result.stored.save_failure = keeper.failure();
    return result;
}

}  // namespace tetralight
