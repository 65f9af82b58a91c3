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

constexpr std::string_view kJsonKey = "tetralight", kMetadataKey = "tetralightMetadata",
                           kNamesKey = "tetralightNames", kProbesKey = "tetralightReflections";

/// What a file of reflection probes holds.
struct Contents {
    std::vector<ReflectionProbe> probes;
    ReflectionsView view;  ///< of `probes` and of the bytes
    std::string_view names;
};

Result<std::vector<ReflectionProbe>> read_probes(std::optional<std::string_view> value,
                                                 uint32_t count) {
    if (!value) {
        return Error{ErrorCode::Unsupported, std::string(kProbesKey), "",
                     "the texture is not of reflection probes: a key is missing"};
    }
    if (value->size() != count * sizeof(ReflectionProbe)) {
        return Error{ErrorCode::Corrupt, std::string(kProbesKey), "",
                     str_cat("the probes have ", value->size(), " bytes instead of ",
                             count * sizeof(ReflectionProbe))};
    }
    std::vector<ReflectionProbe> probes(count);
    std::memcpy(probes.data(), value->data(), value->size());
    return probes;
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
        view.levels[i] = {reinterpret_cast<const RadianceTexel*>(cubes.levels[i].data()),
                          cubes.levels[i].size() / sizeof(RadianceTexel)};
    }
}

/// Reads and verifies all bytes of a file.
Result<Contents> read_contents(std::span<const std::byte> bytes) {
    const auto cubes = detail::read_ktx2_cubes(bytes);
    if (!cubes) return cubes.error();
    std::array<detail::Ktx2Wanted, 3> wanted{{{kProbesKey}, {kNamesKey}, {kMetadataKey}}};
    if (auto s = detail::find_ktx2_values(cubes->pairs, wanted); !s) return s.error();
    auto probes = read_probes(wanted[0].value, cubes->header.layer_count);
    if (!probes) return probes.error();
    Contents contents;
    contents.probes = std::move(*probes);
    contents.names = wanted[1].value.value_or("");
    set_levels(*cubes, contents.view);
    contents.view.probes = contents.probes;
    contents.view.metadata = wanted[2].value.value_or("");
    if (auto s = check_reflection_names(contents.names, contents.probes.size()); !s) {
        return s.error();
    }
    if (auto s = verify(contents.view); !s) return s.error();
    return contents;
}

Status verify_written_reflections(std::span<const std::byte> bytes) {
    const auto contents = read_contents(bytes);
    if (!contents) return contents.error();
    return Ok{};
}

/// A text with the zero that ends it in key/value data.
std::string_view with_zero(const std::string& text) {
    return {text.c_str(), text.size() + 1};
}

/// Key/value data. Names and metadata end where their value ends, without a zero.
std::string make_pairs(const Reflections& reflections) {
    std::string names;
    for (const std::string& name : reflections.names) names += name + '\n';
    const auto probes = std::as_bytes(std::span(reflections.probes));
    std::string pairs;
    append_ktx2_pair(pairs, "KTXorientation", with_zero("rd"));
    append_ktx2_pair(pairs, "KTXwriter", with_zero("tetralight"));
    append_ktx2_pair(pairs, kJsonKey, with_zero(detail::reflection_json(reflections)));
    if (!reflections.metadata.empty()) append_ktx2_pair(pairs, kMetadataKey, reflections.metadata);
    if (!names.empty()) append_ktx2_pair(pairs, kNamesKey, names);
    append_ktx2_pair(pairs, kProbesKey,
                     {reinterpret_cast<const char*>(probes.data()), probes.size()});
    return pairs;
}

Ktx2Header make_header(const Reflections& reflections, size_t pairs_size) {
    Ktx2Header header;
    header.vk_format = kVkFormatRgba16Float;
    header.type_size = 2;
    header.width = header.height = reflections.size;
    header.layer_count = static_cast<uint32_t>(reflections.probes.size());
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
        const uint64_t size = reflections.levels[i].size() * kTexel;
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
    static Result<ReflectionFile> open(const std::string& path) {
        auto mapping = MappedFile::open(path);
        if (!mapping) return mapping.error();
        auto contents = read_contents(mapping->bytes());
        if (!contents) return contents.error().in(shown_path(path));
        ReflectionFile file;
        file.file_ = std::move(*mapping);
        file.probes_ = std::move(contents->probes);
        file.view_ = contents->view;
        file.view_.probes = file.probes_;
        file.names_ = contents->names;
        return file;
    }
};

std::vector<std::string_view> ReflectionFile::names() const {
    return split_names(names_);
}

Result<ReflectionFile> open_reflection_file(const std::string& path) {
    return ReflectionFileReader::open(path);
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
    return write_file(path, pieces_of(head, reflections), verify_written_reflections);
}

}  // namespace tetralight
