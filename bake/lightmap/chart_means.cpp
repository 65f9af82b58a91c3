// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/chart_means.h>

#include <tetralight/bake/parallel.h>
#include <tetralight/probes/no_index.h>

namespace tetralight {
namespace {

struct Sum {
    double value = 0.0;
    int count = 0;

    Sum& operator+=(const Sum& other) {
        value += other.value;
        count += other.count;
        return *this;
    }
};

void add_tile(const PageCharts& pages, const PageCharts::Tile& tile, int radius,
              std::span<const double> values, std::span<double> means) {
    const glm::ivec2 inner = tile.high - tile.low, size = inner + 2 * radius;
    const auto at = [&](int x, int y) { return static_cast<size_t>(y * size.x + x); };
    std::vector<uint32_t> texels(at(0, size.y));
    pages.copy_texels(tile.chart, tile.low - radius, size, texels);
    std::vector<Sum> rows(texels.size());
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < inner.x; ++x) {
            for (int i = 0; i <= 2 * radius; ++i) {
                const uint32_t texel = texels[at(x + i, y)];
                if (texel != kNoIndex) rows[at(x, y)] += {values[texel], 1};
            }
        }
    }
    for (int y = 0; y < inner.y; ++y) {
        for (int x = 0; x < inner.x; ++x) {
            const uint32_t own = pages.texel_of(tile.chart, tile.low + glm::ivec2(x, y));
            if (own == kNoIndex) continue;
            Sum sum;
            for (int i = 0; i <= 2 * radius; ++i) sum += rows[at(x, y + i)];
            means[own] = sum.value / sum.count;
        }
    }
}

}  // namespace

std::vector<double> chart_means(const PageCharts& pages, std::span<const double> values, int radius,
                                uint32_t thread_count) {
    std::vector<double> means(values.size(), 0.0);
    const std::vector<PageCharts::Tile> tiles = pages.tiles();
    parallel_for(tiles.size(), thread_count,
                 [&](size_t i) { add_tile(pages, tiles[i], radius, values, means); });
    return means;
}

}  // namespace tetralight
