// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/write_lppv.h>

#include <cctype>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <vector>

#include <tetralight/bake/image/texture_3d.h>
#include <tetralight/bake/image/write_layered_exr.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/compact_probes.h>
#ifdef TETRALIGHT_HAS_OPENVDB
#include <tetralight/lppv/vdb/write_vdb.h>
#endif

namespace tetralight {
namespace {

/// One pixel a grid point: (z · width of a slice + x, y).
struct Slices {
    std::vector<IrradianceSh> irradiance;
    std::vector<glm::vec4> occlusion;
    std::vector<float> validity;
};

Slices side_by_side(const Lppv& lppv) {
    const glm::uvec3 size = lppv.grid.resolution;
    Slices slices;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t z = 0; z < size.z; ++z) {
            for (uint32_t x = 0; x < size.x; ++x) {
                const size_t i = lppv.grid.point_index({x, y, z});
                slices.irradiance.push_back(lppv.irradiance[i]);
                slices.validity.push_back(lppv.validity.empty() ? 1.0f : lppv.validity[i]);
                if (!lppv.occlusion.empty()) slices.occlusion.push_back(lppv.occlusion[i]);
            }
        }
    }
    return slices;
}

LayeredImage layered_image(const Lppv& lppv, const Slices& slices) {
    const glm::uvec3 size = lppv.grid.resolution;
    LayeredImage image{size.x * size.z, size.y, {}, {}};
    for (size_t k = 0; k < kShCoefficientCount; ++k) {
        for (int c = 0; c < 3; ++c) {
            image.channels.push_back({str_cat("sh", k, ".", "RGB"[c]),
                                      &slices.irradiance[0].coefficients[k][c],
                                      sizeof(IrradianceSh)});
        }
    }
    image.channels.push_back({"validity.V", slices.validity.data(), sizeof(float)});
    for (int c = 0; c < 4 && !slices.occlusion.empty(); ++c) {
        image.channels.push_back(
            {str_cat("occlusion.", "RGBA"[c]), &slices.occlusion[0][c], sizeof(glm::vec4)});
    }
    image.attributes = {
        {"sh:basis", "real orthonormal, all-positive polynomials, index l(l+1)+m"},
        {"sh:quantity", "irradiance, not divided by pi; linear Rec.709 RGB"},
        {"sh:axes", "right-handed, Y up, metres (glTF)"},
        {"lppv:slices", str_cat(size.z, " slices of ", size.x, " x ", size.y,
                                " points side by side, z grows to the right, y downwards")}};
    return image;
}

Status write_texture(const std::string& path, const Lppv& lppv, const LppvFileSettings& settings) {
    const LppvTexture texture = make_lppv_texture(lppv, settings.layout, settings.precision);
    const bool is_half = texture.format == LppvTexelFormat::Half;
    const Texture3dView view{texture.size.x, texture.size.y, texture.size.z,
                             is_half ? TexelFormat::Rgba16Float : TexelFormat::Rgba32Float,
                             texture.texels};
    if (settings.kind == LppvFileKind::Dds) return write_dds(path, view);
    return write_ktx2(path, view, {{"tetralight", lppv_constants_json(lppv, settings.layout)}});
}

Status write_voxels(const std::string& path, [[maybe_unused]] const Lppv& lppv,
                    [[maybe_unused]] const LppvFileSettings& settings) {
#ifdef TETRALIGHT_HAS_OPENVDB
    if (settings.kind == LppvFileKind::NanoVdb) {
        return write_nvdb(path, lppv, settings.thread_count);
    }
    const bool is_half = settings.precision == LppvTexelFormat::Half;
    return write_vdb(path, lppv, is_half ? VdbPrecision::Half : VdbPrecision::Float,
                     settings.thread_count);
#else
    return Error{ErrorCode::Unsupported,
                 path + ": cannot write (this program was built without OpenVDB)"};
#endif
}

std::string json_array(const float* values, size_t count) {
    std::string json = "[";
    for (size_t i = 0; i < count; ++i) json += str_cat(i == 0 ? "" : ",", values[i]);
    return json + "]";
}

}  // namespace

std::optional<LppvFileKind> lppv_file_kind(const std::string& path) {
    static const std::map<std::string, LppvFileKind> kinds{{"vdb", LppvFileKind::OpenVdb},
                                                           {"nvdb", LppvFileKind::NanoVdb},
                                                           {"exr", LppvFileKind::OpenExr},
                                                           {"dds", LppvFileKind::Dds},
                                                           {"ktx2", LppvFileKind::Ktx2}};
    const size_t name = path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1;
    const size_t point = path.rfind('.');
    if (point == std::string::npos || point <= name) return LppvFileKind::OpenVdb;
    std::string extension = path.substr(point + 1);
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto kind = kinds.find(extension);
    if (kind == kinds.end()) return std::nullopt;
    return kind->second;
}

Status write_lppv(const std::string& path, const Lppv& lppv, const LppvFileSettings& settings) {
    switch (settings.kind) {
        case LppvFileKind::OpenExr: {
            const Slices slices = side_by_side(lppv);
            const bool is_half = settings.precision == LppvTexelFormat::Half;
            return write_layered_exr(path, layered_image(lppv, slices),
                                     is_half ? ExrPrecision::Half : ExrPrecision::Float);
        }
        case LppvFileKind::Dds:
        case LppvFileKind::Ktx2:
            return write_texture(path, lppv, settings);
        default:
            return write_voxels(path, lppv, settings);
    }
}

float largest_value(const Lppv& lppv, const LppvFileSettings& settings) {
    return is_texture(settings.kind) ? largest_texel_value(lppv, settings.layout)
                                     : largest_coefficient(lppv.irradiance);
}

std::string lppv_constants_json(const Lppv& lppv, LppvLayout layout) {
    const LppvConstants c = make_lppv_constants(lppv, layout);
    const auto vector = [](const glm::vec4& v) { return json_array(&v[0], 4); };
    return str_cat("{\"layout\":\"", layout == LppvLayout::FourSlabs ? "four slabs" : "seven slabs",
                   "\",\"local_from_world\":", json_array(glm::value_ptr(c.local_from_world), 16),
                   ",\"params\":", vector(c.params), ",\"low\":", vector(c.low),
                   ",\"size_inverse\":", vector(c.size_inverse), ",\"shb_r\":", vector(c.shb_r),
                   ",\"shb_g\":", vector(c.shb_g), ",\"shb_b\":", vector(c.shb_b),
                   ",\"shc\":", vector(c.shc), "}");
}

}  // namespace tetralight
