// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::cli {

/// Gathers positions, so that many are answered in one call, and never holds more than some ten
/// thousand.
class PositionChunks {
  public:
    using Answer = std::function<Status(std::span<const glm::vec3>)>;

    static constexpr size_t kCapacity = 32768;

    explicit PositionChunks(Answer answer) : answer_(std::move(answer)) {
        positions_.reserve(kCapacity);
    }

    [[nodiscard]] Status add(const glm::vec3& position) {
        positions_.push_back(position);
        return positions_.size() < kCapacity ? Status(Ok{}) : flush();
    }

    /// Answers those that are held.
    [[nodiscard]] Status flush() {
        if (positions_.empty()) return Ok{};
        auto status = answer_(positions_);
        positions_.clear();
        return status;
    }

  private:
    Answer answer_;
    std::vector<glm::vec3> positions_;
};

}  // namespace tetralight::cli
