// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/suggest.h>

#include <algorithm>
#include <vector>

namespace tetralight {
namespace {

/// Optimal string alignment distance.
size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<size_t>> d(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i) {
        for (size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            const size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
            const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (is_swap) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

}  // namespace

std::string closest(std::string_view word, std::span<const std::string> candidates) {
    constexpr size_t kLongest = 100;
    if (word.empty() || word.size() > kLongest) return "";
    std::string best;
    size_t best_distance = std::max<size_t>(word.size() / 3, 1) + 1;
    for (const std::string& candidate : candidates) {
        const bool is_begin = word.size() > 2 && candidate.starts_with(word);
        const size_t found = is_begin ? 1 : distance(word, candidate);
        if (found >= best_distance) continue;
        best = candidate;
        best_distance = found;
    }
    return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
    const std::string near = closest(word, candidates);
    return near.empty() ? "" : "; did you mean " + near + "?";
}

}  // namespace tetralight
