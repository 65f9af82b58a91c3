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

struct Target {
    std::string_view name;
    std::string (*run)(uint64_t seed);  ///< empty: nothing is wrong
};

[[nodiscard]] std::span<const Target> targets();

}  // namespace tetralight::fuzz
