// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/query_position.h>

namespace tetralight::cli {

/// Gathers positions, so that many are answered in one call, and never holds more than some ten
/// thousand.
class PositionChunks {
  public:
    /// Answers positions; `normals` has one for each, or is empty.
    using Answer = std::function<Status(std::span<const glm::vec3> positions,
                                        std::span<const glm::vec3> normals)>;

    static constexpr size_t kCapacity = 32768;

    PositionChunks(Normals normals, Answer answer)
        : has_normals_(normals), answer_(std::move(answer)) {
        positions_.reserve(kCapacity);
        if (has_normals_ == Normals::Given) normals_.reserve(kCapacity);
    }

    /// What the reader has to read of each position.
    [[nodiscard]] Normals normals() const { return has_normals_; }

    [[nodiscard]] Status add(const QueryPosition& position) {
        positions_.push_back(position.position);
        if (has_normals_ == Normals::Given) normals_.push_back(position.normal);
        return positions_.size() < kCapacity ? Status(Ok{}) : flush();
    }

    /// Answers those that are held.
    [[nodiscard]] Status flush() {
        if (positions_.empty()) return Ok{};
        auto status = answer_(positions_, normals_);
        positions_.clear();
        normals_.clear();
        return status;
    }

  private:
    Normals has_normals_;
    Answer answer_;
    std::vector<glm::vec3> positions_;
    std::vector<glm::vec3> normals_;
};

}  // namespace tetralight::cli
