// SPDX-License-Identifier: Apache-2.0
#include "tests/portability/check_sizes.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/query_output.h>
#include <tetralight/probes/recombine.h>
#include <tetralight/probes/section_file.h>
#include <tetralight/runtime/tetralight.h>

namespace tetralight::portability {
namespace {

using detail::FileHeader;
using detail::SectionEntry;

/// What a 32-bit number of bytes does not show.
constexpr uint64_t kWrap = uint64_t{1} << 32;

/// The file with another number of elements in a section, and a header with the right checksum.
std::vector<std::byte> with_element_count(std::span<const std::byte> file, size_t section,
                                          uint64_t element_count) {
    std::vector<std::byte> bytes(file.begin(), file.end());
    FileHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    std::vector<SectionEntry> table(header.section_count);
    const size_t table_size = table.size() * sizeof(SectionEntry);
    std::memcpy(table.data(), bytes.data() + sizeof header, table_size);
    table[section].element_count = element_count;
    header.checksum = detail::header_checksum(header, table);
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memcpy(bytes.data() + sizeof header, table.data(), table_size);
    return bytes;
}

bool is_refused(const std::vector<std::byte>& bytes) {
    tetralight_error error = {};
    tetralight_volume* volume = nullptr;
    const auto status = tetralight_open_memory(bytes.data(), bytes.size(), &volume, &error);
    tetralight_close(volume);
    return status == TETRALIGHT_CORRUPT &&
           std::string_view(error.message).find("do not fit in the file") != std::string_view::npos;
}

/// The size of the section is the same modulo 2^32.
bool refuses_large_sections(std::span<const std::byte> file) {
    FileHeader header;
    std::memcpy(&header, file.data(), sizeof header);
    for (size_t i = 0; i < header.section_count; ++i) {
        SectionEntry entry;
        std::memcpy(&entry, file.data() + sizeof header + i * sizeof entry, sizeof entry);
        // A multiple of 2^32 bytes for every size of elements.
        const uint64_t count = entry.element_count + kWrap;
        if (!is_refused(with_element_count(file, i, count))) return false;
    }
    return header.section_count > 0;
}

/// 2^16 layers of 2^16 probes, whose light is missing: the product is 0 modulo 2^32.
bool refuses_missing_layers() {
    constexpr size_t kCount = size_t{1} << 16;
    const std::vector<glm::vec3> positions(kCount);
    const std::vector<Layer> layers(kCount);
    ProbeVolumeView volume;
    volume.positions = positions;
    volume.layers = layers;
    const auto info = check_weights(volume, std::vector<float>(kCount, 1.0f));
    return !info && info.error().code == ErrorCode::Corrupt;
}

/// The second value of an answer lies 2^32 - 4 bytes behind the first or further.
bool refuses_large_strides() {
    std::array<std::byte, 256> memory{};
    StridedOutput output;
    output.memory = memory;
    output.answer_stride = 4;
    output.value_stride = ~size_t{3};
    return output.capacity(27, sizeof(float)) == 0;
}

}  // namespace

std::string check_sizes(std::span<const std::byte> file) {
    if (!refuses_large_sections(file)) return "a section of 2^32 bytes too many was accepted";
    if (!refuses_missing_layers()) return "the light of 2^32 layers of probes was not missed";
    if (!refuses_large_strides()) return "a stride beyond the memory was accepted";
    return {};
}

}  // namespace tetralight::portability
