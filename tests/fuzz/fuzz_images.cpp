// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <vector>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/seed_files.h"
#include "tests/fuzz/targets.h"
#include "tests/support/image_files.h"
#include "tests/support/temp_folder.h"

namespace tetralight::fuzz {
namespace {

/// Larger images are not decoded: they take time and find nothing else.
constexpr uint64_t kMaxPixels = uint64_t{1} << 20;

/// What is wrong with how a file is taken, and whether it is refused.
struct Verdict {
    std::string problem;
    bool is_refused = false;
};

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

Verdict refused(const Error& error, const std::string& name) {
    const std::string& message = error_text(error);
    const bool is_named = message.starts_with(name + ": ");
    return {is_named ? "" : "the error does not name the file: " + message, true};
}

bool is_good(const std::array<uint8_t, 4>&) {
    return true;
}

bool is_good(const glm::vec3& pixel) {
    return std::min({pixel.x, pixel.y, pixel.z}) >= 0.0f &&
           std::max({pixel.x, pixel.y, pixel.z}) <= 1e30f;
}

/// `image` is decoded from a file whose header has `size`.
template <class Image>
std::string problem_of(const Image& image, const Result<ImageSize>& size) {
    if (!size) return "an image is decoded whose size cannot be read";
    if (image.width != size->width || image.height != size->height) {
        return str_cat("an image of ", size->width, " x ", size->height, " pixels has ",
                       image.width, " x ", image.height);
    }
    if (image.pixels.size() != size_t{image.width} * image.height || image.pixels.empty()) {
        return str_cat(image.width, " x ", image.height, " pixels are ", image.pixels.size());
    }
    const bool are_good =
        std::ranges::all_of(image.pixels, [](const auto& pixel) { return is_good(pixel); });
    return are_good ? "" : "a pixel is negative or too large";
}

bool is_large(const Result<ImageSize>& size) {
    return size && uint64_t{size->width} * size->height > kMaxPixels;
}

Verdict judge_image8(const std::string& file) {
    const auto size = read_image_size(bytes_of(file), "a");
    if (!size) {
        const Verdict verdict = refused(size.error(), "a");
        if (!verdict.problem.empty()) return verdict;
    }
    if (is_large(size)) return {};
    const auto image = decode_image8(bytes_of(file), "a");
    if (!image) return refused(image.error(), "a");
    return {problem_of(*image, size)};
}

Verdict judge_hdr(const std::string& file) {
    static const TempFolder folder;
    const std::string path = folder.write("a", file);
    const auto size = read_hdr_image_size(path);
    if (is_large(size)) return {};
    const auto image = read_hdr_image(path);
    if (!image) return refused(image.error(), path);
    return {problem_of(image->image, size)};
}

Verdict judge(const std::string& file) {
    const bool is_exr = file.starts_with("\x76\x2f\x31\x01");
    return is_exr || file.starts_with("#?") ? judge_hdr(file) : judge_image8(file);
}

/// Makes the checksums of a PNG's chunks right, as far as chunks can be found.
void repair_checksums(std::string& file) {
    constexpr size_t kSignature = 8, kAround = 12;  // length, type and checksum
    for (size_t place = kSignature; place + kAround <= file.size();) {
        size_t length = 0;
        for (size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<uint8_t>(file[place + i]);
        if (length > file.size() - place - kAround) return;
        const uint32_t checksum = test::crc32(std::string_view(file).substr(place + 4, length + 4));
        file.replace(place + 8 + length, 4, test::big_endian(checksum, 4));
        place += kAround + length;
    }
}

void change(Mutator& mutator, std::string& file) {
    for (size_t count = mutator.below(4) + 1; count > 0; --count) mutator.change_file(file);
}

/// Radiance files: flat, and run-length encoded in both ways.
std::string sound_hdr(size_t kind) {
    const std::string pixel("\x80\x40\x20\x82", 4);
    const std::string literal("\x08\x80\x81\x82\x83\x84\x85\x86\x87", 9),
        runs("\x88\x40\x88\x20", 4);
    const std::string line = std::string("\x02\x02\x00\x08", 4) + literal + runs + "\x88\x82";
    switch (kind) {
        case 0:
            return test::radiance_file("-Y 2 +X 3", pixel + pixel + pixel + pixel + pixel + pixel);
        case 1:
            return test::radiance_file("-Y 3 +X 8", line + line + line);
        default:
            return test::radiance_file("-Y 2 +X 5", pixel + std::string("\1\1\1\4", 4) + pixel +
                                                        pixel + std::string("\1\1\1\3", 4));
    }
}

std::string replay(const std::string& path) {
    const Verdict verdict = judge(read_text(path));
    const bool must_be_refused =
        std::filesystem::path(path).filename().string().starts_with("refused_");
    return must_be_refused && !verdict.is_refused ? "is not refused" : verdict.problem;
}

}  // namespace

std::string fuzz_images(uint64_t seed) {
    static const std::vector<std::string> files = seed_files(TETRALIGHT_FUZZ_SEEDS "/images");
    Mutator mutator(seed);
    std::string file = files[mutator.below(files.size())];
    change(mutator, file);
    if (mutator.below(8) != 0 && file.starts_with("\x89PNG")) repair_checksums(file);
    return judge(file).problem;
}

std::string fuzz_hdr(uint64_t seed) {
    Mutator mutator(seed);
    std::string file = sound_hdr(mutator.below(3));
    change(mutator, file);
    return judge(file).problem;
}

std::string replay_image(const std::string& path) {
    return replay(path);
}

}  // namespace tetralight::fuzz
