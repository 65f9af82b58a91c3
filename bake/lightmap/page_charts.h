// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

#include <tetralight/bake/lightmap/seams.h>
#include <tetralight/probes/no_index.h>

namespace tetralight {

/// The surfaces that lie in pages, as neighborhoods of texels: within a chart, and across the seams
/// where it meets others.
class PageCharts {
  public:
    /// Texels of one chart in a page: `low` ≤ texel < `high`.
    struct Chart {
        uint32_t page = 0;
        glm::ivec2 low{0}, high{0};
    };

    /// A part of a chart: `low` ≤ texel < `high` in its page.
    struct Tile {
        uint32_t chart = 0;
        glm::ivec2 low{0}, high{0};
    };

    PageCharts(uint32_t page_size, uint32_t page_count);

    /// Adds the charts of an instance. `charts`: as `TexelMap::charts`, rows of `width` texels, for
    /// a rectangle that begins at `corner`.
    void add(uint32_t page, glm::ivec2 corner, uint32_t width, std::span<const uint32_t> charts);

    /// Names the texel of a chart at a place of a page.
    void set_texel(uint32_t page, glm::ivec2 place, uint32_t texel);

    /// Joins charts whose texels are set. A seam beside which a chart is narrower than three texels
    /// is left out: it has no clear side.
    void add_seams(std::span<const Seam> seams);

    [[nodiscard]] const std::vector<Chart>& charts() const { return charts_; }

    /// Parts of all charts, of at most 32 × 32 texels.
    [[nodiscard]] std::vector<Tile> tiles() const;

    /// The texel at a place of a chart, or kNoIndex.
    [[nodiscard]] uint32_t texel_of(uint32_t chart, glm::ivec2 place) const;

    /// Texels around a part of a chart, continued across its seams by what lies there. The part
    /// begins at `low` in the page; `texels` has `size.x` · `size.y` elements, row by row, and
    /// receives kNoIndex where no texel is.
    void copy_texels(uint32_t chart, glm::ivec2 low, glm::ivec2 size,
                     std::span<uint32_t> texels) const;

  private:
    /// A seam as one chart sees it: its own edge, and that of the chart behind it.
    struct Border {
        uint32_t chart = 0;
        uint32_t other_chart = 0;
        uint32_t other_page = 0;
        glm::vec2 begin{0.0f}, along{0.0f};  ///< along: from end to end
        glm::vec2 outside{0.0f};             ///< unit
        glm::vec2 other_begin{0.0f}, other_along{0.0f};
        glm::vec2 other_inside{0.0f};  ///< texels there for one texel of `outside`
    };

    [[nodiscard]] size_t index_of(uint32_t page, glm::ivec2 place) const;
    [[nodiscard]] bool is_in_page(glm::ivec2 place) const;
    [[nodiscard]] uint32_t chart_at(uint32_t page, glm::vec2 point) const;
    /// The chart of an edge, and the unit direction into it; kNoIndex if it is not clear.
    [[nodiscard]] std::pair<uint32_t, glm::vec2> side_of(const PageEdge& edge) const;
    void add_border(const PageEdge& edge, const PageEdge& other);
    void continue_across(const Border& border, glm::ivec2 low, glm::ivec2 size,
                         std::span<uint32_t> texels) const;

    int page_size_ = 0;
    std::vector<uint32_t> chart_of_texel_;  ///< of the pages
    std::vector<uint32_t> texels_;          ///< of the pages
    std::vector<Chart> charts_;
    std::vector<Border> borders_;         ///< by chart
    std::vector<uint32_t> first_border_;  ///< of each chart, and the number of all
};

}  // namespace tetralight
