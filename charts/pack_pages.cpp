// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/pack_pages.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/charts/detail/skyline.h>

namespace tetralight {

namespace {

/// Larger keys are placed first.
using PageOrderKey = std::pair<uint64_t, uint64_t> (*)(TexelSize);

constexpr std::array<PageOrderKey, 4> kPageOrders = {
    [](TexelSize size) { return std::pair<uint64_t, uint64_t>(size.height, size.width); },
    [](TexelSize size) { return std::pair<uint64_t, uint64_t>(size.width, size.height); },
    [](TexelSize size) {
        return std::pair<uint64_t, uint64_t>(std::max(size.width, size.height),
                                             std::min(size.width, size.height));
    },
    [](TexelSize size) {
        return std::pair<uint64_t, uint64_t>(uint64_t{size.width} * size.height, size.height);
    }};

struct PagePacking {
    size_t page_count = 0;
    uint32_t last_height = 0;
    std::vector<PagePlace> places;
};

bool is_empty(TexelSize size) {
    return size.width == 0 || size.height == 0;
}

/// A place in the first page that has one.
PagePlace place_in_pages(TexelSize size, uint32_t page_size, std::vector<detail::Skyline>& pages) {
    for (uint32_t page = 0;; ++page) {
        if (page == pages.size()) pages.emplace_back(page_size);
        if (const auto place = pages[page].try_place(size)) return {page, place->x, place->y};
    }
}

PagePacking pack_in_order(std::span<const TexelSize> sizes, uint32_t page_size, PageOrderKey key) {
    std::vector<uint32_t> order(sizes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, std::greater<>(), [&](uint32_t i) { return key(sizes[i]); });
    std::vector<detail::Skyline> pages;
    PagePacking packing;
    packing.places.resize(sizes.size());
    for (const uint32_t i : order) {
        if (!is_empty(sizes[i])) packing.places[i] = place_in_pages(sizes[i], page_size, pages);
    }
    packing.page_count = pages.size();
    packing.last_height = pages.empty() ? 0 : pages.back().used_height();
    return packing;
}

}  // namespace

Result<std::vector<PagePlace>> pack_pages(std::span<const TexelSize> sizes, uint32_t page_size) {
    TETRALIGHT_ASSERT(page_size > 0, "page_size > 0");
    for (size_t i = 0; i < sizes.size(); ++i) {
        const auto [width, height] = sizes[i];
        if (is_empty(sizes[i]) || std::max(width, height) <= page_size) continue;
        const std::string size = str_cat(width, " × ", height);
        return Error(
            ErrorCode::InvalidArgument, str_cat("rectangles[", i, "]"), size,
            str_cat("rectangle ", i, " has ", size, " texels, more than the page of ", page_size));
    }
    PagePacking best;
    const auto cost = [](const PagePacking& p) { return std::pair(p.page_count, p.last_height); };
    for (const PageOrderKey key : kPageOrders) {
        PagePacking packing = pack_in_order(sizes, page_size, key);
        if (key == kPageOrders[0] || cost(packing) < cost(best)) best = std::move(packing);
    }
    return std::move(best.places);
}

}  // namespace tetralight
