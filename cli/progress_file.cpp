// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/progress_file.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

namespace tetralight::cli {
namespace {

constexpr double kSecondsBetweenWrites = 0.5;

}  // namespace

float share_at_target(const BakeProgress& progress) {
    return static_cast<float>(progress.probes_at_target) /
           static_cast<float>(std::max<size_t>(progress.probe_count, 1));
}

ProgressFile::ProgressFile(std::string path, const ProgressUnit& unit)
    : path_(std::move(path)), unit_(unit) {}

void ProgressFile::show(const BakeProgress& progress, const Pace& pace) {
    last_ = progress;
    last_pace_ = pace;
    const bool is_last = progress.probes_done == progress.probe_count;
    const bool is_news = is_last || (pace.seconds_left && !has_told_time_left_);
    if (pace.seconds < next_write_seconds_ && !is_news) return;
    has_told_time_left_ = pace.seconds_left.has_value();
    next_write_seconds_ = pace.seconds + kSecondsBetweenWrites;
    write(progress, pace);
}

void ProgressFile::set_at_target(size_t count) {
    last_.probes_at_target = count;
    write(last_, last_pace_);
}

void ProgressFile::write(const BakeProgress& progress, const Pace& pace) const {
    if (path_.empty()) return;
    Json json{{unit_.done_member, progress.probes_done},
              {unit_.count_member, progress.probe_count},
              {"rays", progress.ray_count},
              {"rays_per_second", pace.rays_per_second},
              {"seconds_left", nullptr},
              {"at_target", nullptr},
              {"share_at_target", nullptr}};
    if (pace.seconds_left) json["seconds_left"] = *pace.seconds_left;
    if (progress.has_target) {
        json["at_target"] = progress.probes_at_target;
        json["share_at_target"] = share_at_target(progress);
    }
    if (preview_ > 0) json["preview"] = preview_;
    const std::string beside = path_ + ".new";
    std::ofstream(beside) << dump(json) << '\n';
    std::error_code error;
    std::filesystem::rename(beside, path_, error);
}

}  // namespace tetralight::cli
