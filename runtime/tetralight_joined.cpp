// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <new>

#include <tetralight/probes/build/joined_volume.h>
#include <tetralight/runtime/detail/c_arrays.h>
#include <tetralight/runtime/detail/c_errors.h>
#include <tetralight/runtime/detail/c_volume.h>
#include <tetralight/runtime/tetralight.h>

struct tetralight_joined {
    tetralight::JoinedVolume joined;
    tetralight_volume volume{joined.view()};
};

namespace {

using namespace tetralight;
using detail::CallError;
using detail::check_pointer;
using detail::finish;
using detail::succeed;

}  // namespace

tetralight_status tetralight_joined_create(tetralight_joined** joined,
                                           tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("joined", joined)) return finish(wrong, error);
    auto* created = new (std::nothrow) tetralight_joined;
    if (!created) return finish({TETRALIGHT_OUT_OF_MEMORY, "no memory for volumes"}, error);
    *joined = created;
    return succeed(error);
}

void tetralight_joined_destroy(tetralight_joined* joined) noexcept {
    delete joined;
}

tetralight_status tetralight_joined_add(tetralight_joined* joined, const char* name,
                                        const tetralight_volume* part,
                                        tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("joined", joined)) return finish(wrong, error);
    if (auto wrong = check_pointer("name", name)) return finish(wrong, error);
    if (auto wrong = check_pointer("part", part)) return finish(wrong, error);
    if (part == &joined->volume) {
        return finish({TETRALIGHT_BAD_VALUE, "volumes cannot join themselves"}, error);
    }
    const auto status = joined->joined.add(name, part->view);
    return status ? succeed(error) : finish(status.error(), error);
}

tetralight_status tetralight_joined_remove(tetralight_joined* joined, const char* name,
                                           tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("joined", joined)) return finish(wrong, error);
    if (auto wrong = check_pointer("name", name)) return finish(wrong, error);
    const auto status = joined->joined.remove(name);
    if (status) return succeed(error);
    CallError wrong = status.error();
    wrong.status = TETRALIGHT_NOT_THERE;
    return finish(wrong, error);
}

tetralight_status tetralight_joined_step(tetralight_joined* joined, uint32_t budget_microseconds,
                                         uint32_t* is_ready, tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("joined", joined)) return finish(wrong, error);
    if (auto wrong = check_pointer("is_ready", is_ready)) return finish(wrong, error);
    const auto step = joined->joined.step(std::chrono::microseconds(budget_microseconds));
    if (!step) return finish(step.error(), error);
    *is_ready = *step ? 1 : 0;
    return succeed(error);
}

tetralight_status tetralight_joined_commit(tetralight_joined* joined,
                                           tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("joined", joined)) return finish(wrong, error);
    joined->joined.commit();
    joined->volume.source = joined->volume.view = joined->joined.view();
    return succeed(error);
}

const tetralight_volume* tetralight_joined_volume(const tetralight_joined* joined) noexcept {
    return joined == nullptr ? nullptr : &joined->volume;
}
