// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/fill_texels.h>

#include <algorithm>
#include <utility>

namespace tetralight {
namespace {

class FillBuilder {
  public:
    FillBuilder(const TexelMap& map, const std::vector<bool>& has_light)
        : map_(map), is_filled_(map.charts.size(), false) {
        fill_.texel_count = map.charts.size();
        for (size_t i = 0; i < map.texels.size(); ++i) {
            if (has_light[i]) is_filled_[map.texels[i].index] = true;
        }
    }

    TexelFill run() {
        const bool is_dark = std::ranges::none_of(is_filled_, [](bool filled) { return filled; });
        if (is_dark) return std::move(fill_);
        add_mean();
        const auto is_same_chart = [this](uint32_t texel, uint32_t other) {
            return map_.charts[texel] == map_.charts[other];
        };
        std::vector<uint32_t> dark = texels_that([this](uint32_t texel) {
            return map_.charts[texel] != kNoIndex && !is_filled_[texel];
        });
        while (grow(dark, is_same_chart)) {
        }
        for (const uint32_t texel : dark) {
            add_step(texel, {static_cast<uint32_t>(fill_.texel_count)});
            is_filled_[texel] = true;
        }
        std::vector<uint32_t> free =
            texels_that([this](uint32_t texel) { return map_.charts[texel] == kNoIndex; });
        grow(free, [this](uint32_t, uint32_t other) { return map_.charts[other] != kNoIndex; });
        return std::move(fill_);
    }

  private:
    void add_step(uint32_t texel, const std::vector<uint32_t>& sources) {
        fill_.steps.push_back({texel, static_cast<uint32_t>(fill_.sources.size()),
                               static_cast<uint32_t>(sources.size())});
        fill_.sources.insert(fill_.sources.end(), sources.begin(), sources.end());
    }

    void add_mean() {
        add_step(static_cast<uint32_t>(fill_.texel_count),
                 texels_that([this](uint32_t texel) { return bool{is_filled_[texel]}; }));
    }

    template <class Holds>
    [[nodiscard]] std::vector<uint32_t> texels_that(const Holds& holds) const {
        std::vector<uint32_t> texels;
        for (uint32_t i = 0; i < fill_.texel_count; ++i) {
            if (holds(i)) texels.push_back(i);
        }
        return texels;
    }

    /// Gives each texel the mean of its neighbors with light before the call, and leaves those
    /// without such neighbors in `texels`. False if no texel changed.
    template <class IsSource>
    bool grow(std::vector<uint32_t>& texels, const IsSource& is_source) {
        std::vector<uint32_t> grown, rest;
        for (const uint32_t texel : texels) {
            const std::vector<uint32_t> sources = neighbors(texel, is_source);
            if (!sources.empty()) add_step(texel, sources);
            (sources.empty() ? rest : grown).push_back(texel);
        }
        for (const uint32_t texel : grown) is_filled_[texel] = true;
        texels = std::move(rest);
        return !grown.empty();
    }

    template <class IsSource>
    [[nodiscard]] std::vector<uint32_t> neighbors(uint32_t texel, const IsSource& is_source) const {
        const uint32_t column = texel % map_.width, row = texel / map_.width;
        std::vector<uint32_t> found;
        for (uint32_t y = row == 0 ? 0 : row - 1; y <= row + 1 && y < map_.height; ++y) {
            for (uint32_t x = column == 0 ? 0 : column - 1; x <= column + 1 && x < map_.width;
                 ++x) {
                const uint32_t other = y * map_.width + x;
                if (other != texel && is_filled_[other] && is_source(texel, other))
                    found.push_back(other);
            }
        }
        return found;
    }

    const TexelMap& map_;
    std::vector<bool> is_filled_;
    TexelFill fill_;
};

}  // namespace

TexelFill make_texel_fill(const TexelMap& map, const std::vector<bool>& has_light) {
    return FillBuilder(map, has_light).run();
}

}  // namespace tetralight
