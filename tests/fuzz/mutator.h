// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>

namespace tetralight::fuzz {

/// Random changes of inputs. The same seed makes the same changes.
class Mutator {
  public:
    explicit Mutator(uint64_t seed) : engine_(seed) {}

    /// A number below `count`. Precondition: count > 0.
    [[nodiscard]] size_t below(size_t count);

    /// Overwrites a number somewhere in `bytes` by a value that programs stumble over (0, -1, the
    /// largest, NaN, infinity...), flips a bit, or copies one part over another. The size stays.
    void change_bytes(std::span<std::byte> bytes);

    /// Changes bytes, or inserts, removes or repeats some. Empty files stay so.
    void change_file(std::string& file);

    /// Changes, inserts, removes or repeats a part of a text.
    void change_text(std::string& text);

  private:
    void write_number(std::span<std::byte> bytes);

    std::mt19937_64 engine_;
};

}  // namespace tetralight::fuzz
