// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv_texture.h>

namespace tetralight {

/// Kinds of files that hold a proxy volume.
enum class LppvFileKind : uint8_t {
    OpenVdb,  ///< .vdb: nine grids of vectors, compressed
    NanoVdb,  ///< .nvdb: the same for GPUs, floats
    OpenExr,  ///< .exr: channels sh0.R .. sh8.B, z slices side by side, the lowest y on top
    Dds,      ///< .dds: a 3D texture, `LppvTexture`
    Ktx2,     ///< .ktx2: the same, with the shader's constants as JSON
};

/// True for textures, which have a layout.
[[nodiscard]] constexpr bool is_texture(LppvFileKind kind) noexcept {
    return kind == LppvFileKind::Dds || kind == LppvFileKind::Ktx2;
}

/// The kind by the extension of a path; OpenVdb without an extension; nothing if it is unknown.
[[nodiscard]] std::optional<LppvFileKind> lppv_file_kind(const std::string& path);

struct LppvFileSettings {
    LppvFileKind kind = LppvFileKind::OpenVdb;
    /// Ignored for NanoVdb, which stores floats.
    LppvTexelFormat precision = LppvTexelFormat::Half;
    /// For textures only.
    LppvLayout layout = LppvLayout::SevenSlabs;
    /// 0 = all.
    uint32_t thread_count = 0;
};

/// Writes a proxy volume; halves saturate at ±kLargestHalf in every kind of file. The old file
/// stays whole on failure. Returns unsupported for a kind that this program was built without.
[[nodiscard]] Status write_lppv(const std::string& path, const Lppv& lppv,
                                const LppvFileSettings& settings);

/// The largest magnitude of the values that such a file stores, before they saturate at the largest
/// half.
[[nodiscard]] float largest_value(const Lppv& lppv, const LppvFileSettings& settings);

/// The members of `LppvConstants` as JSON, for the shader that reads the texture.
[[nodiscard]] std::string lppv_constants_json(const Lppv& lppv, LppvLayout layout);

}  // namespace tetralight
