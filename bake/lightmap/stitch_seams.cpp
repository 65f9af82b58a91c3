// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/stitch_seams.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// Places per texel of the longer side of a seam.
constexpr double kPlacesPerTexel = 2.0;

/// Differences count relative to this fraction of the mean light of all seams at least: darker
/// places look black.
constexpr double kCountedFraction = 0.01;

/// Most rounds of finding texels below 0; what is left is a rounding error.
constexpr int kMaxRounds = 8;

glm::dvec2 place_on(const PageEdge& edge, double t) {
    return glm::mix(glm::dvec2(edge.begin), glm::dvec2(edge.end), t);
}

/// Calls visit(texel, weight) for the texels of a bilinear sample.
template <class Visit>
void for_each_bilinear(const PageEdge& edge, double t, uint32_t page_size, const Visit& visit) {
    const double last = page_size - 1.0;
    const glm::dvec2 place = glm::clamp(place_on(edge, t) - 0.5, 0.0, last);
    const glm::dvec2 corner = glm::min(glm::floor(place), glm::dvec2(last - 1.0));
    const glm::dvec2 f = place - corner;
    for (int i = 0; i < 4; ++i) {
        const int dx = i % 2, dy = i / 2;
        const double weight = (dx == 1 ? f.x : 1.0 - f.x) * (dy == 1 ? f.y : 1.0 - f.y);
        if (weight <= 0.0) continue;
        const auto x = static_cast<uint64_t>(corner.x) + static_cast<uint64_t>(dx);
        const auto y = static_cast<uint64_t>(corner.y) + static_cast<uint64_t>(dy);
        visit((uint64_t{edge.page} * page_size + y) * page_size + x, weight);
    }
}

}  // namespace

struct SeamStitcher::Equations {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
};

SeamStitcher::SeamStitcher(std::span<const Seam> seams, uint32_t page_size,
                           const std::function<double(uint64_t)>& weight) {
    std::vector<uint64_t> all;  // the texel of each entry
    for (const Seam& seam : seams) add_seam(seam, page_size, all);
    texels_ = all;
    std::ranges::sort(texels_);
    texels_.erase(std::unique(texels_.begin(), texels_.end()), texels_.end());
    for (size_t i = 0; i < all.size(); ++i) {
        entries_[i].texel =
            static_cast<uint32_t>(std::ranges::lower_bound(texels_, all[i]) - texels_.begin());
    }
    for (const uint64_t texel : texels_) weights_.push_back(weight(texel));
    is_zero_.assign(texels_.size(), false);
    equations_ = std::make_unique<Equations>();
    factor();
}

SeamStitcher::~SeamStitcher() = default;

void SeamStitcher::add_seam(const Seam& seam, uint32_t page_size, std::vector<uint64_t>& all) {
    const double length =
        std::max(glm::distance(glm::dvec2(seam.first.begin), glm::dvec2(seam.first.end)),
                 glm::distance(glm::dvec2(seam.second.begin), glm::dvec2(seam.second.end)));
    const auto count = static_cast<uint32_t>(std::ceil(kPlacesPerTexel * length)) + 1;
    for (uint32_t i = 0; i < count; ++i) {
        const double t = (i + 0.5) / count;
        const auto add = [&](double sign) {
            return [&, sign](uint64_t texel, double weight) {
                all.push_back(texel);
                entries_.push_back({0, static_cast<float>(sign * weight)});
            };
        };
        for_each_bilinear(seam.first, t, page_size, add(1.0));
        for_each_bilinear(seam.second, t, page_size, add(-1.0));
        row_begins_.push_back(entries_.size());
        lengths_.push_back(static_cast<float>(kPlacesPerTexel * length / count));
    }
}

std::vector<double> SeamStitcher::differences(std::span<const double> values) const {
    std::vector<double> result(place_count(), 0.0);
    for (size_t row = 0; row < result.size(); ++row) {
        for (size_t i = row_begins_[row]; i < row_begins_[row + 1]; ++i)
            result[row] += double{entries_[i].factor} * values[entries_[i].texel];
    }
    return result;
}

double SeamStitcher::relative_percentile(std::span<const double> values, double fraction) const {
    const std::vector<double> all = differences(values);
    std::vector<double> lights(all.size(), 0.0);  // means of both sides
    double length = 0.0, mean = 0.0;
    for (size_t row = 0; row < all.size(); ++row) {
        for (size_t i = row_begins_[row]; i < row_begins_[row + 1]; ++i)
            lights[row] += 0.5 * std::abs(double{entries_[i].factor}) * values[entries_[i].texel];
        length += double{lengths_[row]};
        mean += double{lengths_[row]} * lights[row];
    }
    if (!(mean > 0.0)) return 0.0;
    mean /= length;
    std::vector<std::pair<double, double>> relative;  // difference, length
    for (size_t row = 0; row < all.size(); ++row) {
        const double light = std::max(lights[row], kCountedFraction * mean);
        relative.emplace_back(std::abs(all[row]) / light, double{lengths_[row]});
    }
    std::ranges::sort(relative);
    double below = 0.0;
    for (const auto& [difference, own] : relative) {
        below += own;
        if (below >= fraction * length) return difference;
    }
    return relative.back().first;
}

void SeamStitcher::factor() {
    if (texels_.empty()) return;
    std::vector<Eigen::Triplet<double>> terms;  // of W + Aᵀ L A, lower triangle
    for (uint32_t i = 0; i < texels_.size(); ++i)
        terms.emplace_back(i, i, is_zero_[i] ? 1.0 : weights_[i]);
    for (size_t row = 0; row < place_count(); ++row) {
        const auto entries =
            std::span(entries_).subspan(row_begins_[row], row_begins_[row + 1] - row_begins_[row]);
        for (const Entry& a : entries) {
            for (const Entry& b : entries) {
                if (b.texel > a.texel || is_zero_[a.texel] || is_zero_[b.texel]) continue;
                terms.emplace_back(a.texel, b.texel,
                                   double{lengths_[row]} * double{a.factor} * double{b.factor});
            }
        }
    }
    const auto size = static_cast<Eigen::Index>(texels_.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(terms.begin(), terms.end());
    equations_->factors.compute(matrix);
    TETRALIGHT_ASSERT(equations_->factors.info() == Eigen::Success, "weights are above 0");
}

std::vector<double> SeamStitcher::stitched(std::span<const double> values) const {
    // (W + Aᵀ L A) x = W x_0 for the texels that are not held at 0.
    if (texels_.empty()) return {};
    Eigen::VectorXd right(static_cast<Eigen::Index>(values.size()));
    for (size_t i = 0; i < values.size(); ++i)
        right[static_cast<Eigen::Index>(i)] = is_zero_[i] ? 0.0 : weights_[i] * values[i];
    const Eigen::VectorXd x = equations_->factors.solve(right);
    return {x.begin(), x.end()};
}

void SeamStitcher::hold_zeros(std::span<const double> values) {
    for (int round = 0; round < kMaxRounds; ++round) {
        const std::vector<double> x = stitched(values);
        bool is_done = true;
        for (size_t i = 0; i < x.size(); ++i) {
            if (x[i] >= 0.0) continue;
            is_zero_[i] = true;
            is_done = false;
        }
        if (is_done) break;
        factor();
    }
}

}  // namespace tetralight
