// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/sound_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/layered_volume.h"

namespace tetralight::fuzz {
namespace {

ProbeVolume make_volume(size_t kind) {
    if (kind == 0) {
        ProbeVolume volume = test::make_layered_volume(24, 3, 7);
        volume.lights.resize(2);
        volume.light_names = "sun\nlamp\n";
        volume.light_states.resize(2);
        volume.occlusion_lights.assign(24, {0, 1, kNoIndex, kNoIndex});
        volume.occlusion.assign(24, glm::vec4(0.5f));
        volume.validity.assign(24, 1.0f);
        volume.health.resize(24);
        volume.rendering_layers.assign(24, 0b1001);
        make_compact_probes(volume);
        const ProbeEdges edges(volume.view());
        std::vector<uint8_t> codes(edges.size(), 0);
        for (size_t edge = 0; edge < codes.size(); edge += 5) codes[edge] = 200;
        store_visibility(edges, codes, volume);
        return volume;
    }
    std::vector<glm::dvec3> positions = test::random_positions(kind == 3 ? 1 : 12, kind);
    for (glm::dvec3& p : positions) {
        p.y = 0.0;
        if (kind == 2) p.z = 0.0;
    }
    return test::make_lit_volume(positions);
}

const std::vector<std::byte>& bytes_of(size_t kind) {
    static const auto files = [] {
        std::array<std::vector<std::byte>, kVolumeKinds> all;
        for (size_t k = 0; k < all.size(); ++k) all[k] = probe_file_bytes(make_volume(k).view());
        return all;
    }();
    return files[kind];
}

/// Writes the numbers of a line. Returns false if there are none or they do not fit.
template <class T>
bool write_numbers(std::istream& line, std::span<std::byte> section) {
    size_t offset = 0;
    std::string word;
    if (!(line >> offset)) return false;
    bool has_written = false;
    while (line >> word) {
        const auto value = static_cast<T>(std::strtod(word.c_str(), nullptr));
        if (offset + sizeof value > section.size()) return false;
        std::memcpy(section.data() + offset, &value, sizeof value);
        offset += sizeof value;
        has_written = true;
    }
    return has_written;
}

bool negate(std::span<std::byte> section) {
    for (size_t offset = 0; offset + sizeof(float) <= section.size(); offset += sizeof(float)) {
        section[offset + 3] ^= std::byte{0x80};  // the sign of a little-endian float
    }
    return !section.empty();
}

/// Follows one line below "section". Returns false if it is wrong.
bool change(const std::string& type, std::istream& line, std::span<std::byte> section) {
    if (type == "f64") return write_numbers<double>(line, section);
    if (type == "f32") return write_numbers<float>(line, section);
    if (type == "u32") return write_numbers<uint32_t>(line, section);
    if (type == "u8") return write_numbers<uint8_t>(line, section);
    return type == "negate" && negate(section);
}

}  // namespace

SoundFile::SoundFile(size_t kind) : bytes_(bytes_of(kind)) {
    std::memcpy(&header_, bytes_.data(), sizeof header_);
    table_.resize(header_.section_count);
    std::memcpy(table_.data(), bytes_.data() + sizeof header_, table_.size() * sizeof table_[0]);
}

std::span<std::byte> SoundFile::section(size_t index) {
    return std::span(bytes_).subspan(table_[index].offset, table_[index].size());
}

std::span<std::byte> SoundFile::section(std::string_view name) {
    for (size_t i = 0; i < table_.size(); ++i) {
        if (name == table_[i].name.data()) return section(i);
    }
    return {};
}

std::vector<std::byte> SoundFile::finish() {
    for (size_t i = 0; i < table_.size(); ++i) table_[i].checksum = detail::checksum(section(i));
    std::memcpy(bytes_.data() + sizeof header_, table_.data(), table_.size() * sizeof table_[0]);
    header_.checksum = detail::header_checksum(header_, table_);
    std::memcpy(bytes_.data(), &header_, sizeof header_);
    return std::move(bytes_);
}

std::vector<std::byte> file_of_changes(const std::string& path) {
    std::ifstream text(path);
    std::string line;
    SoundFile file(0);
    std::span<std::byte> section;
    while (std::getline(text, line)) {
        std::istringstream words(line);
        std::string word;
        if (!(words >> word) || word == "#") continue;
        size_t kind = 0;
        std::string name;
        if (word == "volume" && words >> kind && kind < kVolumeKinds) {
            file = SoundFile(kind);
        } else if (word == "section" && words >> name) {
            section = file.section(name);
        } else if (!change(word, words, section)) {
            ADD_FAILURE() << path << ": " << line;
        }
    }
    return file.finish();
}

}  // namespace tetralight::fuzz
