// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <string_view>

#include <tetralight/base/result.h>
#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/delaunay/memory_source.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// A probe volume that baked volumes join and leave while queries read it, as in a game that
/// streams its level or opens prefabs:
///
///     JoinedVolume joined;
///     if (auto status = joined.add("level", level.view()); !status) return status.error();
///     // In each frame:
///     const auto is_ready = joined.step(std::chrono::microseconds(500));
///     if (!is_ready) return is_ready.error();
///     if (*is_ready) joined.commit();
///
/// The cost is that of the probes that come or go, not of those that are there, with four
/// exceptions, in which all is made anew in one `step`: the first volumes; while all probes lie in
/// a plane or on a line; while some are so near to each other that `merge` welds them; and when
/// probes come that are twice as far from the origin as those before.
///
/// Cells are those of one Delaunay tetrahedralization of all probes. After any history they are the
/// same, up to their order: `canonical` has the bytes of a volume that was made at once.
///
/// Not thread-safe, but for one case: queries of `view` may run beside `add`, `remove` and `step`.
class JoinedVolume {
  public:
    explicit JoinedVolume(const MergeSettings& settings = {}, const MemorySource& memory = {});
    ~JoinedVolume();
    JoinedVolume(JoinedVolume&&) noexcept;
    JoinedVolume& operator=(JoinedVolume&&) noexcept;

    /// Orders that a volume joins. It must stay where it is until it has left and `commit` was
    /// called. Returns invalid_argument if one of this name is there or was ordered, if the name is
    /// empty or has control characters or bytes that are not UTF-8, or if the volume has no exact
    /// positions, one that is not finite or beyond 1e18, or light of another number of probes.
    Status add(std::string_view name, const ProbeVolumeView& part);

    /// Orders that a volume leaves. Returns not_found if there is none of this name, and none was
    /// ordered.
    Status remove(std::string_view name);

    /// Works on orders for about `budget`, 0.1 ms at least. True: all are worked on, and `commit`
    /// makes them visible. Returns out_of_resources if memory is short: `view` is as before, and
    /// the next call begins anew.
    [[nodiscard]] Result<bool> step(std::chrono::nanoseconds budget);

    /// Changes `view` to what `step` has finished. No query may run meanwhile; views from before
    /// are invalid. Without effect until `step` returned true.
    void commit();

    /// The volume that queries read. `verify` is for `canonical`: here copies of a hull cell may
    /// stand at the end of `cells`.
    [[nodiscard]] ProbeVolumeView view() const;

    /// The volume of the parts that are there once all that `step` has finished is committed, in
    /// canonical order.
    [[nodiscard]] ProbeVolume canonical() const;

  private:
    struct State;

    std::unique_ptr<State> state_;
};

}  // namespace tetralight
