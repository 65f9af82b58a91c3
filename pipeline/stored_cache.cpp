// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/stored_cache.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include <tetralight/bake/lightmap/make_radiance_cache.h>
#include <tetralight/pipeline/bake_key.h>

namespace tetralight {
namespace {

using Irradiance = RadianceCache::Irradiance;

static_assert(sizeof(Irradiance) == 36 && std::is_trivially_copyable_v<Irradiance>);

/// Of all that the light of the cache depends on.
StoreKey key_of(const Scene& scene, const PreparedLightmaps& prepared) {
    Sha256 hash;
    hash.add("radiance cache 1");
    const Sha256Digest light = light_key(scene, prepared.settings.bake);
    hash.add(std::as_bytes(std::span(light)));
    const uint64_t texels = cache_key(prepared);
    hash.add(std::as_bytes(std::span(&texels, 1)));
    return hash.digest();
}

/// The light of all texels, that of their layers, and a byte a texel that says whether it is
/// trusted.
std::vector<std::byte> bytes_of(const RadianceCache& cache) {
    std::vector<std::byte> bytes;
    const auto add = [&bytes](const auto& values) {
        const auto more = std::as_bytes(std::span(values));
        bytes.insert(bytes.end(), more.begin(), more.end());
    };
    add(cache.irradiance);
    add(cache.layer_irradiance);
    add(std::vector<uint8_t>(cache.is_trusted.begin(), cache.is_trusted.end()));
    return bytes;
}

/// Returns false if the bytes are of another number of texels or layers.
bool read(std::span<const std::byte> bytes, size_t texel_count, RadianceCache& cache) {
    const size_t layer_texel_count = texel_count * cache.layer_count;
    if (bytes.size() != sizeof(Irradiance) * (texel_count + layer_texel_count) + texel_count)
        return false;
    const auto take = [&bytes]<class T>(std::vector<T>& values, size_t count) {
        values.resize(count);
        if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
        bytes = bytes.subspan(count * sizeof(T));
    };
    take(cache.irradiance, texel_count);
    take(cache.layer_irradiance, layer_texel_count);
    for (const std::byte flag : bytes) cache.is_trusted.push_back(flag != std::byte{0});
    cache.has_reflected = true;
    return true;
}

}  // namespace

Result<RadianceCache> stored_radiance_cache(const Scene& scene, const PreparedLightmaps& prepared,
                                            BakeStore* store, const BakeCallback& callback) {
    const BakeSettings& settings = prepared.settings.bake;
    const StoreKey key = store != nullptr ? key_of(scene, prepared) : StoreKey{};
    if (store != nullptr) {
        const auto bytes = store->find(key);
        RadianceCache cache =
            empty_radiance_cache(scene, prepared.layout, prepared.maps, prepared.texels);
        cache.layer_count = settings.plan.layer_count;
        if (bytes && read(*bytes, prepared.texels.positions.size(), cache)) return cache;
    }
    auto made = make_radiance_cache(scene, prepared.layout, prepared.maps, prepared.texels,
                                    settings, {}, callback);
    if (!made || store == nullptr) return made;
    const auto bytes = bytes_of(*made);
    if (auto status = store->put(std::vector<StoreEntry>{{key, bytes}}); !status)
        return status.error();
    return made;
}

}  // namespace tetralight
