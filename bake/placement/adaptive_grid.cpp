// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/adaptive_grid.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/bake/placement/light_pool.h>
#include <tetralight/bake/placement/refine_cells.h>
#include <tetralight/bake/placement/remove_probes.h>
#include <tetralight/bake/placement/sensor_errors.h>
#include <tetralight/bake/placement/sensors.h>
#include <tetralight/bake/placement/sights.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Sensors off surfaces are a little farther from them than places that need not be covered.
constexpr double kSlack = 1.001;
/// The minimum number of sensors, sensors per probe, and the maximum number.
constexpr size_t kMinSensors = 4096, kSensorsPerProbe = 20, kMaxSensors = 1 << 17;
/// One of this many sensors is not used for decisions; these give the reported error.
constexpr uint32_t kCheckEvery = 4;
/// New probes of a round, as a fraction of the current ones.
constexpr double kGrowth = 0.25;
/// Refinement goes beyond the targets by these factors, so that removal has a choice.
constexpr double kBeyondCount = 1.3, kBeyondError = 0.9;
/// Refinement goes on until at most this share of sensors is uncovered, or until a round leaves
/// more than this fraction of it.
constexpr double kUncovered = 0.005, kHardlyLess = 0.9;
/// The maximum noise of the sensors, as a fraction of the error.
constexpr double kMaxNoise = 0.5;
/// Rounds of replacing the least useful probes at most, the fraction that is replaced at first, and
/// the one at which it ends.
constexpr int kReplacements = 48;
constexpr double kReplacedFraction = 0.2, kLeastFraction = 0.02, kShrink = 0.7;
/// A round that leaves more than this fraction of the cost hardly helps.
constexpr double kHardlyBetter = 0.985;

class AdaptiveGrid {
  public:
    AdaptiveGrid(const AdaptiveInput& input, const AdaptiveSettings& settings,
                 const AdaptiveCallback& callback)
        : input_(input),
          settings_(settings),
          callback_(callback),
          pool_(input.scene, pool_settings(input, settings)),
          places_(input.traced, input.bounds, kSlack * input.place_clearance, input.is_allowed),
          sights_(input.traced, pool_),
          remover_(view()) {}

    Result<AdaptiveReport> run(std::vector<PlacedProbe>& probes,
                               const std::vector<bool>& is_protected) {
        take_start(probes, is_protected);
        report_.start_probe_count = set_.probes.size();
        for (const glm::dvec3& sensor : input_.sensors) add_sensor(sensor);
        Status status = refine();
        if (status) status = remove_and_replace();
        if (!status && status.error().code != ErrorCode::Cancelled) return status.error();
        if (!best_ && is_time_over()) {
            return Error{ErrorCode::InvalidArgument, "time_budget",
                         str_cat(settings_.time_budget_seconds),
                         "out of time before there was a result"};
        }
        if (!best_) return Error{ErrorCode::Cancelled, "interrupted"};
        if (!status)
            report_.end = is_time_over() ? AdaptiveEnd::TimeOver : AdaptiveEnd::Interrupted;
        finish(probes);
        return report_;
    }

  private:
    /// Probes, their light, and its errors.
    struct Set {
        std::vector<uint32_t> probes;  ///< indices in the pool
        ProbeVolume volume;
        std::vector<SensorError> errors;  ///< one for each sensor used for decisions
        /// At the other sensors: the error without noise, and the share that is uncovered.
        double error = std::numeric_limits<double>::infinity();
        double uncovered = 1.0;
        /// Of all sensors used for decisions.
        double cost = std::numeric_limits<double>::infinity();
    };

    static BakeSettings pool_settings(const AdaptiveInput& input,
                                      const AdaptiveSettings& settings) {
        BakeSettings bake = settings.bake;
        bake.thread_count = input.thread_count;
        return bake;
    }

    void take_start(const std::vector<PlacedProbe>& probes, const std::vector<bool>& is_protected) {
        for (size_t i = 0; i < probes.size(); ++i) {
            if (!is_kept(probes[i].fate)) continue;
            set_.probes.push_back(add_to_pool(probes[i].position));
            is_protected_.back() = !is_protected.empty() && is_protected[i];
            start_places_.push_back(i);
        }
        start_count_ = pool_.size();
    }

    uint32_t add_to_pool(const glm::dvec3& position) {
        is_protected_.push_back(false);
        is_to_cover_.push_back(double{distance_at(position)} >= input_.place_clearance);
        return pool_.add(position);
    }

    [[nodiscard]] SensorView view() { return {pool_, sights_, scale_, is_to_cover_}; }

    [[nodiscard]] bool is_time_over() const {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
        return settings_.time_budget_seconds > 0.0 &&
               elapsed.count() > settings_.time_budget_seconds;
    }

    /// Reports progress. Returns false if the caller cancels or the time is over.
    bool report_progress() {
        if (is_time_over()) return false;
        const Set& shown = best_ ? *best_ : set_;
        return !callback_ ||
               callback_({report_.round_count, shown.probes.size(),
                          std::isfinite(shown.error) ? shown.error : 0.0, is_removing_});
    }

    void add_sensors() {
        const size_t wanted =
            std::clamp(kSensorsPerProbe * set_.probes.size(), kMinSensors, kMaxSensors);
        const size_t count = sensors_.size() + checks_.size();
        if (count >= wanted) return;
        for (const glm::dvec3& place :
             places_.next(std::max(wanted - count, count / 2), input_.thread_count)) {
            add_sensor(place);
        }
    }

    void add_sensor(const glm::dvec3& place) {
        const uint32_t sensor = add_to_pool(place);
        (++sensor_count_ % kCheckEvery == 0 ? checks_ : sensors_).push_back(sensor);
    }

    Status bake() {
        return pool_.bake([this](const BakeProgress&) { return report_progress(); });
    }

    /// Errors are relative to the mean light of the first sensors.
    void set_scale() {
        double sum = 0.0;
        for (const uint32_t sensor : sensors_) sum += mean_irradiance(pool_.light(sensor));
        scale_ = {settings_.error_kind, sum / static_cast<double>(sensors_.size())};
        remover_.set_scale(scale_);
        has_scale_ = true;
    }

    /// Asks for more samples where the light is noisier than errors may be. Returns false if it is
    /// not, or if no position can have more.
    bool add_samples() {
        const double most = kMaxNoise * std::max(set_.error, settings_.target_error);
        if (mean_noise(pool_, checks_, scale_) < most) return false;
        bool is_any = false;
        for (uint32_t i = 0; i < pool_.size(); ++i) {
            const bool is_noisy = noise_square(pool_, i, scale_) > 0.5 * most * most;
            if (is_noisy && pool_.double_samples(i)) is_any = true;
        }
        return is_any;
    }

    /// Computes the light and the errors of the set, with more samples until errors exceed the
    /// noise.
    Status measure_errors() {
        do {
            add_sensors();
            if (checks_.empty() || sensors_.empty()) {
                return Error{ErrorCode::InvalidArgument, "bounds", "",
                             "the bounds have no free position off surfaces to measure light at"};
            }
            if (auto status = bake(); !status) return status;
            if (!has_scale_) set_scale();
            set_.volume = volume_of(pool_, set_.probes);
            const auto errors =
                sensor_errors(set_.volume, set_.probes, checks_, view(), input_.thread_count);
            const double error = mean_error(errors);
            const double noise = mean_noise(pool_, checks_, scale_);
            set_.error = std::sqrt(std::max(0.0, error * error - noise * noise));
            set_.uncovered =
                static_cast<double>(uncovered_count(errors)) / static_cast<double>(errors.size());
        } while (add_samples());
        set_.errors =
            sensor_errors(set_.volume, set_.probes, sensors_, view(), input_.thread_count);
        set_.cost = sum_of_costs(set_.errors) / static_cast<double>(sensors_.size());
        return Ok{};
    }

    /// Makes the set the result so far.
    Status accept() {
        best_ = set_;
        ++report_.round_count;
        if (!report_progress()) return Error{ErrorCode::Cancelled, "cancelled"};
        return Ok{};
    }

    Status refine() {
        const double most = kBeyondCount * static_cast<double>(input_.max_probes);
        double uncovered = 1.0;
        while (true) {
            if (auto status = measure_errors(); !status) return status;
            // A set with too many probes is not a result.
            if (set_.probes.size() <= input_.max_probes) {
                if (auto status = accept(); !status) return status;
            }
            report_.end = AdaptiveEnd::TargetReached;
            const double before = std::exchange(uncovered, set_.uncovered);
            const bool is_covered = uncovered <= kUncovered || uncovered > kHardlyLess * before;
            if (is_covered && set_.error <= kBeyondError * settings_.target_error) return Ok{};
            report_.end = AdaptiveEnd::MaxProbes;
            const auto room = most - static_cast<double>(set_.probes.size());
            if (room < 1.0) return Ok{};
            if (insert(static_cast<size_t>(room)) > 0) continue;
            report_.end = AdaptiveEnd::NothingToRefine;
            return Ok{};
        }
    }

    /// Adds probes where places cost most; returns their number.
    size_t insert(size_t room) {
        const auto growth = static_cast<size_t>(kGrowth * static_cast<double>(set_.probes.size()));
        std::vector<bool> is_member(pool_.size(), false);
        for (const uint32_t probe : set_.probes) is_member[probe] = true;
        const RefineRule rule{input_.clearance,
                              [&](uint32_t sensor) {
                                  return !is_member[sensor] &&
                                         has_clearance(pool_.position(sensor));
                              },
                              std::min(room, std::max<size_t>(growth, 16)), input_.thread_count};
        const std::vector<uint32_t> found =
            refine_cells({set_.probes, set_.volume, sensors_, set_.errors, view()}, rule);
        set_.probes.insert(set_.probes.end(), found.begin(), found.end());
        report_.peak_probe_count = std::max<uint64_t>(report_.peak_probe_count, set_.probes.size());
        return found.size();
    }

    /// Metres to the nearest surface.
    [[nodiscard]] float distance_at(const glm::dvec3& position) const {
        return surface_distance(input_.traced, input_.traced.render_from_world(position));
    }

    /// True if a probe at the position keeps the clearance. Sensors may be closer to surfaces.
    [[nodiscard]] bool has_clearance(const glm::dvec3& position) const {
        constexpr double kRounding = 0.99;
        return double{distance_at(position)} >= kRounding * input_.clearance;
    }

    /// The sum of costs that corresponds to an error, in proportion to the set's, while no more
    /// places are uncovered.
    [[nodiscard]] double cost_at(double error) const {
        double squares = 0.0;
        for (const SensorError& e : set_.errors) squares += double{e.square};
        const double ratio = set_.error > 0.0 ? error / set_.error : 1.0;
        return sum_of_costs(set_.errors) + squares * (ratio * ratio - 1.0);
    }

    [[nodiscard]] std::vector<uint32_t> spaces_of(const std::vector<uint32_t>& probes) {
        std::vector<uint32_t> spaces;
        for (const uint32_t probe : probes) {
            const auto [known, is_new] = spaces_.try_emplace(probe, kNoIndex);
            if (is_new) known->second = input_.space_of(pool_.position(probe));
            spaces.push_back(known->second);
        }
        return spaces;
    }

    /// Removes probes down to a number, while the error stays below the maximum, and no more
    /// sensors are uncovered. Returns false if no probe could be removed.
    Result<bool> remove(size_t min_count, double max_error,
                        size_t max_uncovered = std::numeric_limits<size_t>::max()) {
        const RemoveRule rule{std::max<size_t>(min_count, 4), cost_at(max_error), max_uncovered,
                              0.125, input_.thread_count};
        auto left = remover_.pass({set_.probes, spaces_of(set_.probes), set_.volume, sensors_,
                                   set_.errors, is_protected_},
                                  rule);
        if (left.size() == set_.probes.size()) return false;
        set_.probes = std::move(left);
        if (auto status = measure_errors(); !status) return status.error();
        return true;
    }

    /// Removes probes down to the maximum, whatever the error.
    Status remove_surplus() {
        while (set_.probes.size() > input_.max_probes) {
            const auto removed = remove(input_.max_probes, std::numeric_limits<double>::max());
            if (!removed) return removed.error();
            if (!*removed) break;  // all remaining probes are protected
        }
        return Ok{};
    }

    Status remove_and_replace() {
        is_removing_ = true;
        if (auto status = remove_surplus(); !status) return status;
        if (best_ && best_->cost < set_.cost) set_ = *best_;
        if (auto status = accept(); !status) return status;
        if (report_.end == AdaptiveEnd::TargetReached || set_.error <= settings_.target_error) {
            report_.end = AdaptiveEnd::TargetReached;
            return remove_to_target();
        }
        return replace();
    }

    Status remove_to_target() {
        const size_t uncovered = uncovered_count(set_.errors);
        const auto few = static_cast<size_t>(kUncovered * static_cast<double>(sensors_.size()));
        while (true) {
            const auto removed = remove(4, settings_.target_error, std::max(uncovered, few));
            if (!removed) return removed.error();
            if (!*removed || set_.error > settings_.target_error) break;
            if (auto status = accept(); !status) return status;
        }
        set_ = *best_;
        return Ok{};
    }

    /// Moves the least useful probes while that helps; fewer of them after a round that did not.
    Status replace() {
        double fraction = kReplacedFraction;
        for (int i = 0; i < kReplacements && fraction >= kLeastFraction; ++i) {
            // A set that is smaller than the maximum has room for more.
            const auto count = static_cast<size_t>(input_.max_probes);
            const size_t unused = count - std::min(count, set_.probes.size());
            const auto room = static_cast<size_t>(std::ceil(fraction * static_cast<double>(count)));
            if (insert(unused + room) == 0) break;
            if (auto status = measure_errors(); !status) return status;
            if (auto status = remove_surplus(); !status) return status;
            const bool is_better = set_.cost < best_->cost && set_.probes.size() <= count;
            const bool is_much_better = is_better && set_.cost < kHardlyBetter * best_->cost;
            if (is_better) {
                if (auto status = accept(); !status) return status;
            } else {
                set_ = *best_;
            }
            if (!is_much_better) fraction *= kShrink;
        }
        set_ = *best_;
        return Ok{};
    }

    /// Writes the best set to `probes`: fates of the start, and new probes behind it.
    void finish(std::vector<PlacedProbe>& probes) {
        std::vector<bool> is_member(pool_.size(), false);
        for (const uint32_t probe : best_->probes) is_member[probe] = true;
        for (size_t i = 0; i < start_count_; ++i) {
            if (!is_member[i]) probes[start_places_[i]].fate = Fate::Redundant;
        }
        std::vector<uint32_t> added;
        for (const uint32_t probe : best_->probes) {
            if (probe >= start_count_) added.push_back(probe);
        }
        std::ranges::sort(added);
        for (const uint32_t probe : added) {
            const glm::dvec3& position = pool_.position(probe);
            probes.push_back({position, Fate::Kept, distance_at(position)});
        }
        report_.error = best_->error;
        report_.position_count = pool_.size();
        report_.sample_count = pool_.sample_count();
        report_.ray_count = pool_.ray_count() + sights_.ray_count();
    }

    const AdaptiveInput& input_;
    const AdaptiveSettings& settings_;
    const AdaptiveCallback& callback_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    LightPool pool_;
    SensorSequence places_;
    ErrorScale scale_;
    std::vector<bool> is_to_cover_;  ///< one for each position of the pool
    Sights sights_;
    ProbeRemover remover_;
    AdaptiveReport report_;
    Set set_;
    std::optional<Set> best_;
    std::vector<bool> is_protected_;    ///< one for each position of the pool
    std::vector<size_t> start_places_;  ///< index in the start of the first positions of the pool
    size_t start_count_ = 0;
    std::map<uint32_t, uint32_t> spaces_;  ///< of probes, by their index in the pool
    std::vector<uint32_t> sensors_, checks_;
    uint32_t sensor_count_ = 0;
    bool is_removing_ = false;
    bool has_scale_ = false;
};

}  // namespace

const char* name_of(AdaptiveEnd end) {
    constexpr const char* kNames[] = {"target reached", "most probes", "time over", "interrupted",
                                      "nothing to refine"};
    return kNames[static_cast<size_t>(end)];
}

Result<AdaptiveReport> refine_grid(const AdaptiveInput& input, const AdaptiveSettings& settings,
                                   std::vector<PlacedProbe>& probes,
                                   const std::vector<bool>& is_protected,
                                   const AdaptiveCallback& callback) {
    return AdaptiveGrid(input, settings, callback).run(probes, is_protected);
}

}  // namespace tetralight
