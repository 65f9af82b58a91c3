// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_visibility.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <vector>

#include <tetralight/bake/blocked_fraction.h>
#include <tetralight/bake/fit_edge_ratios.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/stopwatch.h>
#include <tetralight/pipeline/corner_faces.h>
#include <tetralight/probes/build/probe_edges.h>
#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/edge_visibility.h>

namespace tetralight {
namespace {

class VisibilityBake {
  public:
    VisibilityBake(const TraceScene& traced, std::span<const glm::dvec3> capture_positions,
                   const ProbeVolumeView& volume)
        : traced_(traced),
          volume_(volume),
          edges_(volume),
          corners_(volume),
          is_unclear_(volume.info.inner_cell_count) {
        for (size_t i = 0; i < volume.positions.size(); ++i) {
            positions_.push_back(traced.render_from_world(volume.exact_positions[i]));
            eyes_.push_back(traced.render_from_world(capture_positions[i]));
        }
        const int other_count = cell_vertex_count(volume.info.dimension) - 1;
        if (other_count > 0) {
            fit_positions_ = face_positions(other_count, 4);
            check_positions_ = face_positions(other_count, 2);
            const auto center = face_positions(other_count, 0);
            check_positions_.insert(check_positions_.end(), center.begin(), center.end());
        }
        ratios_.assign(edges_.size(), 0.0);
    }

    VisibilityReport run(uint32_t thread_count, ProbeVolume& volume) {
        const auto probe_count = positions_.size();
        std::vector<uint8_t> is_left_out(probe_count, 0);
        parallel_for(probe_count, thread_count, [&](size_t i) {
            is_left_out[i] = leads_through_wall(i);
            if (is_left_out[i] == 0) trace_edges(static_cast<uint32_t>(i));
        });
        std::vector<uint8_t> codes(edges_.size(), kFreeEdge);
        parallel_for(probe_count, thread_count, [&](size_t i) {
            if (is_left_out[i] == 0) find_codes(static_cast<uint32_t>(i), codes);
        });
        store_visibility(edges_, codes, volume);
        split_walls(thread_count, volume);
        VisibilityReport report;
        report.edge_count = edges_.size();
        report.blocked_edge_count = static_cast<uint64_t>(
            std::ranges::count_if(codes, [](uint8_t code) { return code > kUnknownEdge; }));
        report.marked_cell_count = volume.cell_visibility.size();
        report.unclear_cell_count = static_cast<uint64_t>(
            std::ranges::count_if(is_unclear_, [](const auto& flag) { return flag != 0; }));
        report.left_out_count = static_cast<uint64_t>(std::ranges::count(is_left_out, 1));
        report.ray_count = ray_count_;
        return report;
    }

  private:
    /// True if the way from a probe to where it samples its light leaves free space: it meets a
    /// surface from its front. Out of geometry, surfaces are met from behind.
    [[nodiscard]] bool leads_through_wall(size_t probe) const {
        const glm::vec3 way = eyes_[probe] - positions_[probe];
        if (way == glm::vec3(0.0f)) return false;
        const auto side = traced_.intersect_side({positions_[probe], way, 1.0f});
        return side && !side->is_from_behind;
    }

    void trace_edges(uint32_t probe) {
        const auto targets = edges_.targets(probe);
        for (size_t k = 0; k < targets.size(); ++k) {
            const auto fraction =
                blocked_fraction_of_pencil(traced_, eyes_[probe], positions_[targets[k]]);
            if (fraction) ratios_[edges_.first(probe) + k] = 1.0 / static_cast<double>(*fraction);
        }
        ray_count_ += 5 * targets.size();
    }

    [[nodiscard]] bool is_blocked(size_t edge) const { return ratios_[edge] > 1.0; }

    /// True if different walls block the edges from a probe to two others: then a ray to the middle
    /// between these ends where the largest of both ratios says, and not where their sum does.
    [[nodiscard]] bool is_split(uint32_t probe, uint32_t a, uint32_t b) {
        const double to_a = ratios_[edges_.find(probe, a)], to_b = ratios_[edges_.find(probe, b)];
        const glm::vec3 middle = 0.5f * (positions_[a] + positions_[b]);
        const auto fraction = blocked_fraction(traced_, eyes_[probe], middle);
        ++ray_count_;
        const double ratio = fraction ? 1.0 / static_cast<double>(*fraction) : 1.0;
        const auto error = [&](double predicted) {
            return std::abs(std::max(predicted, 1.0) - ratio);
        };
        return error(0.5 * std::max(to_a, to_b)) < error(0.5 * (to_a + to_b));
    }

    void split_walls(uint32_t thread_count, ProbeVolume& volume) {
        const ProbeVolume& stored = volume;
        parallel_for(volume.cells.size(), thread_count, [&](size_t cell) {
            const uint32_t element = find_visibility(stored.view(), static_cast<uint32_t>(cell));
            if (element == kNoIndex) return;
            set_splits(
                volume.cells[cell], volume.cell_visibility[element],
                [&](uint32_t probe, uint32_t a, uint32_t b) { return is_split(probe, a, b); });
        });
    }

    /// Of a face with two blocked edges and a free one: whether different walls block them.
    [[nodiscard]] bool is_split(const CornerFace& face, const std::array<size_t, 3>& edges) {
        std::array<uint32_t, 3> blocked{};
        size_t count = 0;
        for (int i = 0; i < face.other_count; ++i) {
            if (is_blocked(edges[i])) blocked[count++] = face.others[i];
        }
        if (count != 2) return false;
        const auto [low, high] = std::minmax(blocked[0], blocked[1]);
        return is_split(face.probe, low, high);
    }

    /// Rays from a probe to positions on the face opposite to it, as samples for a fit.
    template <class Use>
    void for_each_sample(const CornerFace& face, std::span<const glm::dvec3> positions, Use use) {
        std::array<size_t, 3> edges{};
        for (int i = 0; i < face.other_count; ++i) {
            edges[i] = edges_.find(face.probe, face.others[i]);
        }
        const bool takes_largest = is_split(face, edges);
        for (const glm::dvec3& weights : positions) {
            RatioSample sample;
            glm::dvec3 target(0.0);
            for (int i = 0; i < face.other_count; ++i) {
                target += weights[i] * glm::dvec3(positions_[face.others[i]]);
                sample.weights[i] = weights[i];
                if (is_blocked(edges[i])) {
                    const double known = weights[i] * ratios_[edges[i]];
                    sample.known =
                        takes_largest ? std::max(sample.known, known) : sample.known + known;
                } else {
                    sample.edges[i] = static_cast<uint32_t>(edges[i] - edges_.first(face.probe));
                }
            }
            const auto fraction = blocked_fraction(traced_, eyes_[face.probe], glm::vec3(target));
            if (fraction) sample.ratio = 1.0 / static_cast<double>(*fraction);
            use(sample);
        }
        ray_count_ += positions.size();
    }

    [[nodiscard]] int count_blocked(const CornerFace& face) const {
        int count = 0;
        for (int i = 0; i < face.other_count; ++i) {
            count += is_blocked(edges_.find(face.probe, face.others[i]));
        }
        return count;
    }

    /// Samples of the faces that blocked and free edges of one probe lead to, and their cells.
    struct FaceSamples {
        std::vector<RatioSample> samples;
        std::vector<uint32_t> cells;
    };

    /// Also marks cells where a ray is blocked though all three edges beside it are free.
    FaceSamples sample_faces(uint32_t probe) {
        FaceSamples found;
        for (const CornerFace& face : corners_.faces(probe)) {
            const int blocked_count = count_blocked(face);
            if (blocked_count == 0) {
                for_each_sample(face, check_positions_, [&](const RatioSample& sample) {
                    if (sample.ratio > 1.0) is_unclear_[face.cell] = 1;
                });
            } else if (blocked_count < face.other_count) {
                for_each_sample(face, fit_positions_, [&](const RatioSample& sample) {
                    found.samples.push_back(sample);
                    found.cells.push_back(face.cell);
                });
            }
        }
        return found;
    }

    /// Fits the free edges of a probe and stores the codes of all of its edges.
    void find_codes(uint32_t probe, std::vector<uint8_t>& codes) {
        const FaceSamples found = sample_faces(probe);
        const size_t first = edges_.first(probe), count = edges_.targets(probe).size();
        const std::vector<double> fitted = fit_edge_ratios(count, found.samples);
        mark_unclear(found, fitted);
        for (size_t k = 0; k < count; ++k) {
            const double ratio = is_blocked(first + k) ? ratios_[first + k] : fitted[k];
            codes[first + k] = encode_edge_ratio(ratio);
        }
    }

    /// Marks the cells where a ray is blocked though the ratios say that it is not.
    void mark_unclear(const FaceSamples& found, std::span<const double> ratios) {
        constexpr double kClearlyBlocked = 1.05;
        for (size_t i = 0; i < found.samples.size(); ++i) {
            const RatioSample& sample = found.samples[i];
            double sum = sample.known;
            for (size_t k = 0; k < 3; ++k) {
                if (sample.edges[k] != kNoIndex) sum += sample.weights[k] * ratios[sample.edges[k]];
            }
            if (sample.ratio > kClearlyBlocked && sum <= 1.0) is_unclear_[found.cells[i]] = 1;
        }
    }

    const TraceScene& traced_;
    const ProbeVolumeView volume_;
    ProbeEdges edges_;
    CornerFaces corners_;
    std::vector<glm::vec3> positions_;
    /// Where probes sample their light.
    std::vector<glm::vec3> eyes_;
    std::vector<glm::dvec3> fit_positions_, check_positions_;
    /// One an edge: 1 / the fraction at which it is blocked, or 0.
    std::vector<double> ratios_;
    /// One an inner cell. Threads only ever write 1.
    std::vector<std::atomic<uint8_t>> is_unclear_;
    std::atomic<uint64_t> ray_count_ = 0;
};

}  // namespace

VisibilityReport bake_visibility(const TraceScene& traced,
                                 std::span<const glm::dvec3> capture_positions,
                                 uint32_t thread_count, ProbeVolume& volume) {
    TETRALIGHT_ASSERT(capture_positions.size() == volume.positions.size(), "one a probe");
    const Stopwatch watch;
    const ProbeVolume& input = volume;
    VisibilityReport report =
        VisibilityBake(traced, capture_positions, input.view()).run(thread_count, volume);
    report.seconds = watch.seconds();
    return report;
}

}  // namespace tetralight
