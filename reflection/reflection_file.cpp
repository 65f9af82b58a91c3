// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/reflection_file.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include <tetralight/base/file_writer.h>
#include <tetralight/base/ktx2.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/section_error.h>
#include <tetralight/probes/section_text.h>
#include <tetralight/reflection/cube.h>
#include <tetralight/reflection/detail/read_ktx2.h>
#include <tetralight/reflection/detail/reflection_json.h>

namespace tetralight {
namespace {

constexpr std::string_view kJsonKey = "tetralight",
                           kLayerIrradianceKey = "tetralightLayerIrradiance",
                           kLayerNamesKey = "tetralightLayerNames", kLayersKey = "tetralightLayers",
                           kMetadataKey = "tetralightMetadata", kNamesKey = "tetralightNames",
                           kProbesKey = "tetralightReflections";

/// What a file of reflection probes holds.
struct Contents {
    std::vector<ReflectionProbe> probes;
    std::vector<ReflectionLayer> layers;
    std::vector<IrradianceSh> layer_irradiance;
    ReflectionsView view;  ///< of these and of the bytes
    std::string_view names;
};

/// The structs of a value.
template <class T>
Result<std::vector<T>> read_values(std::string_view key, std::string_view value, size_t count) {
    if (value.size() != count * sizeof(T)) {
        return Error{
            ErrorCode::Corrupt, std::string(key), "",
            str_cat("\"", key, "\" has ", value.size(), " bytes instead of ", count * sizeof(T))};
    }
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), value.data(), value.size());
    return values;
}

Result<std::vector<ReflectionProbe>> read_probes(std::optional<std::string_view> value,
                                                 uint32_t count) {
    if (!value) {
        return Error{ErrorCode::Unsupported, std::string(kProbesKey), "",
                     "the texture is not of reflection probes: a key is missing"};
    }
    return read_values<ReflectionProbe>(kProbesKey, *value, count);
}

/// The number of probes: of all cubes, each probe has one, and one for each layer.
Result<uint32_t> count_probes(uint32_t cube_count, size_t layer_count) {
    if (cube_count % (1 + layer_count) == 0)
        return static_cast<uint32_t>(cube_count / (1 + layer_count));
    return Error{
        ErrorCode::Corrupt, std::string(kLayersKey), "",
        str_cat(cube_count, " cubes are not those of probes with ", layer_count, " layers each")};
}

Status check_reflection_names(std::string_view names, size_t probe_count) {
    if (auto status = detail::check_names("names", names); !status) return status;
    const size_t count = split_names(names).size();
    if (count == 0 || count == probe_count) return Ok{};
    return detail::section_error("names", str_cat(count, " names for ", probe_count, " probes"));
}

/// Level 0 first, as in the view.
void set_levels(const detail::Ktx2Cubes& cubes, ReflectionsView& view) {
    view.size = cubes.header.width;
    view.level_count = cubes.header.level_count;
    for (uint32_t i = 0; i < view.level_count; ++i) {
        const std::span texels(reinterpret_cast<const RadianceTexel*>(cubes.levels[i].data()),
                               cubes.levels[i].size() / sizeof(RadianceTexel));
        const size_t own = texels.size() / (1 + view.layers.size());
        view.levels[i] = texels.first(own);
        view.layer_levels[i] = texels.subspan(own);
    }
}

/// Layers, probes and irradiance, whose numbers must agree with that of the cubes.
Status read_structs(const detail::Ktx2Cubes& cubes, Contents& contents) {
    std::array<detail::Ktx2Wanted, 6> wanted{{{kProbesKey},
                                              {kNamesKey},
                                              {kMetadataKey},
                                              {kLayersKey},
                                              {kLayerNamesKey},
                                              {kLayerIrradianceKey}}};
    if (auto s = detail::find_ktx2_values(cubes.pairs, wanted); !s) return s;
    const auto value = [&](size_t i) { return wanted[i].value.value_or(""); };
    auto layers = read_values<ReflectionLayer>(kLayersKey, value(3),
                                               value(3).size() / sizeof(ReflectionLayer));
    if (!layers) return layers.error();
    const auto count = count_probes(cubes.header.layer_count, layers->size());
    if (!count) return count.error();
    auto probes = read_probes(wanted[0].value, *count);
    if (!probes) return probes.error();
    auto irradiance =
        read_values<IrradianceSh>(kLayerIrradianceKey, value(5), size_t{*count} * layers->size());
    if (!irradiance) return irradiance.error();
    contents.probes = std::move(*probes);
    contents.layers = std::move(*layers);
    contents.layer_irradiance = std::move(*irradiance);
    contents.names = value(1);
    contents.view.metadata = value(2);
    contents.view.layer_names = value(4);
    return Ok{};
}

/// Reads and verifies all bytes of a file.
Result<Contents> read_contents(std::span<const std::byte> bytes) {
    const auto cubes = detail::read_ktx2_cubes(bytes);
    if (!cubes) return cubes.error();
    Contents contents;
    if (auto s = read_structs(*cubes, contents); !s) return s.error();
    contents.view.probes = contents.probes;
    contents.view.layers = contents.layers;
    contents.view.layer_irradiance = contents.layer_irradiance;
    set_levels(*cubes, contents.view);
    if (auto s = check_reflection_names(contents.names, contents.probes.size()); !s) {
        return s.error();
    }
    if (auto s = verify(contents.view); !s) return s.error();
    return contents;
}

/// A text with the zero that ends it in key/value data.
std::string_view with_zero(const std::string& text) {
    return {text.c_str(), text.size() + 1};
}

template <class T>
std::string_view text_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Key/value data. Names and metadata end where their value ends, without a zero.
std::string make_pairs(const Reflections& reflections) {
    std::string names;
    for (const std::string& name : reflections.names) names += name + '\n';
    std::string pairs;
    append_ktx2_pair(pairs, "KTXorientation", with_zero("rd"));
    append_ktx2_pair(pairs, "KTXwriter", with_zero("tetralight"));
    append_ktx2_pair(pairs, kJsonKey, with_zero(detail::reflection_json(reflections)));
    if (!reflections.layers.empty()) {
        append_ktx2_pair(pairs, kLayerIrradianceKey, text_of(reflections.layer_irradiance));
        append_ktx2_pair(pairs, kLayerNamesKey, reflections.layer_names);
        append_ktx2_pair(pairs, kLayersKey, text_of(reflections.layers));
    }
    if (!reflections.metadata.empty()) append_ktx2_pair(pairs, kMetadataKey, reflections.metadata);
    if (!names.empty()) append_ktx2_pair(pairs, kNamesKey, names);
    append_ktx2_pair(pairs, kProbesKey, text_of(reflections.probes));
    return pairs;
}

Ktx2Header make_header(const Reflections& reflections, size_t pairs_size) {
    Ktx2Header header;
    header.vk_format = kVkFormatRgba16Float;
    header.type_size = 2;
    header.width = header.height = reflections.size;
    header.layer_count =
        static_cast<uint32_t>(reflections.probes.size() * (1 + reflections.layers.size()));
    header.face_count = kCubeFaceCount;
    header.level_count = static_cast<uint32_t>(reflections.levels.size());
    header.descriptor_offset =
        static_cast<uint32_t>(sizeof(Ktx2Header) + header.level_count * sizeof(Ktx2Level));
    header.descriptor_size = sizeof(Ktx2Descriptor);
    header.metadata_offset = header.descriptor_offset + header.descriptor_size;
    header.metadata_size = static_cast<uint32_t>(pairs_size);
    return header;
}

template <class T>
void append_bytes(std::string& to, const T& value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// All before the texels: header, index of levels, descriptor, pairs and padding.
std::string make_head(const Reflections& reflections) {
    const std::string pairs = make_pairs(reflections);
    const Ktx2Header header = make_header(reflections, pairs.size());
    constexpr size_t kTexel = sizeof(RadianceTexel);
    const size_t first_texel =
        (header.metadata_offset + pairs.size() + kTexel - 1) / kTexel * kTexel;
    std::vector<Ktx2Level> index(reflections.levels.size());
    uint64_t offset = first_texel;
    for (size_t i = index.size(); i-- > 0;) {  // the smallest level comes first
        const size_t of_layers =
            i < reflections.layer_levels.size() ? reflections.layer_levels[i].size() : 0;
        const uint64_t size = (reflections.levels[i].size() + of_layers) * kTexel;
        index[i] = {offset, size, size};
        offset += size;
    }
    std::string head;
    append_bytes(head, header);
    for (const Ktx2Level& level : index) append_bytes(head, level);
    append_bytes(head, make_ktx2_descriptor(kTexel));
    head += pairs;
    head.resize(first_texel);
    return head;
}

/// The pieces of a file, one after the other.
std::vector<std::span<const std::byte>> pieces_of(const std::string& head,
                                                  const Reflections& reflections) {
    std::vector<std::span<const std::byte>> pieces{std::as_bytes(std::span(head))};
    for (size_t i = reflections.levels.size(); i-- > 0;) {
        pieces.push_back(std::as_bytes(std::span(reflections.levels[i])));
        if (i < reflections.layer_levels.size())
            pieces.push_back(std::as_bytes(std::span(reflections.layer_levels[i])));
    }
    return pieces;
}

Status check_written(const Reflections& reflections) {
    if (reflections.levels.size() > kMaxReflectionLevels) {
        return Error{
            ErrorCode::InvalidArgument, "levels", "",
            str_cat(reflections.levels.size(), " levels are more than ", kMaxReflectionLevels)};
    }
    if (auto status = verify(reflections.view()); !status) {
        Error error = status.error();
        error.code = ErrorCode::InvalidArgument;
        return error;
    }
    for (const std::string& name : reflections.names) {
        if (auto status = check_characters(name); !status) return status;
    }
    const size_t count = reflections.names.size();
    if (count == 0 || count == reflections.probes.size()) return Ok{};
    return Error{ErrorCode::InvalidArgument, "names", "",
                 str_cat(count, " names for ", reflections.probes.size(), " probes")};
}

}  // namespace

/// Builds a ReflectionFile.
struct ReflectionFileReader {
    static Result<ReflectionFile> open(Result<MappedFile> mapping, const std::string& name) {
        if (!mapping) return mapping.error();
        auto contents = read_contents(mapping->bytes());
        if (!contents) return contents.error().in(name);
        ReflectionFile file;
        file.file_ = std::move(*mapping);
        file.probes_ = std::move(contents->probes);
        file.layers_ = std::move(contents->layers);
        file.layer_irradiance_ = std::move(contents->layer_irradiance);
        file.view_ = contents->view;
        file.view_.probes = file.probes_;
        file.view_.layers = file.layers_;
        file.view_.layer_irradiance = file.layer_irradiance_;
        file.names_ = contents->names;
        return file;
    }
};

Reflections ReflectionFile::copy() const {
    Reflections copy;
    copy.size = view_.size;
    copy.probes = probes_;
    copy.layers = layers_;
    copy.layer_names = view_.layer_names;
    copy.layer_irradiance = layer_irradiance_;
    for (uint32_t i = 0; i < view_.level_count; ++i) {
        copy.levels.emplace_back(view_.levels[i].begin(), view_.levels[i].end());
        if (!layers_.empty())
            copy.layer_levels.emplace_back(view_.layer_levels[i].begin(),
                                           view_.layer_levels[i].end());
    }
    for (const std::string_view name : names()) copy.names.emplace_back(name);
    copy.metadata = view_.metadata;
    return copy;
}

std::vector<std::string_view> ReflectionFile::names() const {
    return split_names(names_);
}

Result<ReflectionFile> open_reflection_file(const std::string& path) {
    return ReflectionFileReader::open(MappedFile::open(path), shown_path(path));
}

Result<ReflectionFile> open_reflection_memory(std::span<const std::byte> bytes) {
    return ReflectionFileReader::open(MappedFile::copy_of(bytes), "memory");
}

std::vector<std::byte> reflection_file_bytes(const Reflections& reflections) {
    const std::string head = make_head(reflections);
    std::vector<std::byte> bytes;
    for (const auto& piece : pieces_of(head, reflections)) {
        bytes.insert(bytes.end(), piece.begin(), piece.end());
    }
    return bytes;
}

Status write_reflection_file(const std::string& path, const Reflections& reflections) {
    if (auto status = check_written(reflections); !status) return status;
    const std::string head = make_head(reflections);
    return write_compared_file(path, pieces_of(head, reflections));
}

}  // namespace tetralight
