// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

// What is fuzzed. A case is a random change of a sound input, named by its seed; the same seed
// gives the same case. A fault that sanitizers and asserts see ends the program; everything else
// that is wrong is returned.

namespace tetralight::fuzz {

/// `.probes` files with numbers changed and checksums repaired: reading them never fails in another
/// way than by an error, and those that pass `verify` and `validate` give light that is finite and
/// lies between that of the probes.
[[nodiscard]] std::string fuzz_probe_file(uint64_t seed);

/// Groups of probes as JSON: read with an error, or merged and joined to a volume that is valid.
[[nodiscard]] std::string fuzz_probe_groups(uint64_t seed);

/// Files of probe groups of other programs (CSV, Godot, Unity) with parts changed: read with an
/// error that names the file, or to groups with names of their own and finite positions.
[[nodiscard]] std::string fuzz_imports(uint64_t seed);

/// PNG, JPEG, WebP and OpenEXR files with bytes changed, and checksums of PNG repaired: decoded
/// with an error, or to an image of the size that the header has.
[[nodiscard]] std::string fuzz_images(uint64_t seed);

/// The same for Radiance files.
[[nodiscard]] std::string fuzz_hdr(uint64_t seed);

/// glTF scenes with values of their JSON and bytes of their buffers and images changed: read with
/// an error that names the file, or to a scene whose indices are in range.
[[nodiscard]] std::string fuzz_gltf(uint64_t seed);

// One case of the corpus: what was taken wrongly once (tests/fuzz/corpus/NAME).

/// A text of `file_of_changes`: the file must be refused.
[[nodiscard]] std::string replay_probe_file(const std::string& path);

/// JSON; must be refused if the name of the file begins with "refused_".
[[nodiscard]] std::string replay_probe_groups(const std::string& path);

/// A file of `fuzz_imports`; must be refused if the name of the file begins with "refused_".
[[nodiscard]] std::string replay_import(const std::string& path);

/// An image or a glTF file; must be refused if the name of the file begins with "refused_".
[[nodiscard]] std::string replay_image(const std::string& path);
[[nodiscard]] std::string replay_gltf(const std::string& path);

struct Target {
    std::string_view name;
    std::string (*run)(uint64_t seed);                    ///< empty: nothing is wrong
    std::string (*replay)(const std::string& path) = {};  ///< the same
};

[[nodiscard]] std::span<const Target> targets();

}  // namespace tetralight::fuzz
