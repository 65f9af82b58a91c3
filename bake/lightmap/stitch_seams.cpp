// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/stitch_seams.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace tetralight {
namespace {

/// Places per texel of the longer side of a seam.
constexpr double kPlacesPerTexel = 2.0;

/// Differences count relative to this fraction of the mean light of all seams at least: darker
/// places look black.
constexpr double kCountedFraction = 0.01;

// Conjugate gradients end at this fraction of the first residual.
constexpr double kResidual = 1e-7;
constexpr int kMaxSteps = 1000;

/// Most rounds of finding texels below 0; what is left is a rounding error.
constexpr int kMaxRounds = 8;

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

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
    diagonal_ = weights_;
    for (size_t row = 0; row < place_count(); ++row) {
        for (size_t i = row_begins_[row]; i < row_begins_[row + 1]; ++i) {
            const double factor{entries_[i].factor};
            diagonal_[entries_[i].texel] += double{lengths_[row]} * factor * factor;
        }
    }
}

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

std::vector<double> SeamStitcher::transposed(std::span<const double> differences) const {
    std::vector<double> result(texels_.size(), 0.0);
    for (size_t row = 0; row < differences.size(); ++row) {
        for (size_t i = row_begins_[row]; i < row_begins_[row + 1]; ++i)
            result[entries_[i].texel] +=
                double{entries_[i].factor} * double{lengths_[row]} * differences[row];
    }
    return result;
}

void SeamStitcher::solve(std::span<const double> values, const std::vector<bool>& is_zero,
                         std::vector<double>& x) const {
    // (W + Aᵀ L A) (x − x_0) = −Aᵀ L A x_0 by conjugate gradients, scaled by the diagonal.
    const auto keep_zeros = [&](std::vector<double>& vector) {
        for (size_t i = 0; i < vector.size(); ++i) {
            if (is_zero[i]) vector[i] = 0.0;
        }
    };
    keep_zeros(x);
    std::vector<double> residual = transposed(differences(x));
    for (size_t i = 0; i < x.size(); ++i)
        residual[i] = -residual[i] - weights_[i] * (x[i] - values[i]);
    keep_zeros(residual);
    const auto scaled = [&](const std::vector<double>& vector) {
        std::vector<double> result = vector;
        for (size_t i = 0; i < result.size(); ++i) result[i] /= diagonal_[i];
        return result;
    };
    std::vector<double> direction = scaled(residual);
    double square = dot(residual, direction);
    const double enough = square * kResidual * kResidual;
    for (int step = 0; step < kMaxSteps && square > enough; ++step) {
        std::vector<double> image = transposed(differences(direction));
        for (size_t i = 0; i < x.size(); ++i) image[i] += weights_[i] * direction[i];
        keep_zeros(image);
        const double length = square / dot(direction, image);
        for (size_t i = 0; i < x.size(); ++i) {
            x[i] += length * direction[i];
            residual[i] -= length * image[i];
        }
        const std::vector<double> next_scaled = scaled(residual);
        const double next = dot(residual, next_scaled);
        for (size_t i = 0; i < x.size(); ++i)
            direction[i] = next_scaled[i] + next / square * direction[i];
        square = next;
    }
}

std::vector<double> SeamStitcher::stitched(std::span<const double> values,
                                           const std::vector<bool>& is_zero) const {
    std::vector<double> x(values.begin(), values.end());
    solve(values, is_zero, x);
    return x;
}

std::vector<bool> SeamStitcher::zeros(std::span<const double> values) const {
    std::vector<bool> is_zero(values.size(), false);
    std::vector<double> x(values.begin(), values.end());
    for (int round = 0; round < kMaxRounds; ++round) {
        solve(values, is_zero, x);
        bool is_done = true;
        for (size_t i = 0; i < x.size(); ++i) {
            if (x[i] >= 0.0 || is_zero[i]) continue;
            is_zero[i] = true;
            is_done = false;
        }
        if (is_done) break;
    }
    return is_zero;
}

}  // namespace tetralight
