// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/base/result.h>
#include <tetralight/cli/values.h>

// The subcommands, one file each.

namespace tetralight::cli {

Status run_backup(const Values& values);  // only with TETRALIGHT_BUILD_SERVER
Status run_bake(const Values& values);
Status run_bake_all(const Values& values);
Status run_check_leaks(const Values& values);
Status run_collect(const Values& values);
Status run_explain(const Values& values);
Status run_export(const Values& values);
Status run_fsck(const Values& values);  // only with TETRALIGHT_BUILD_SERVER
Status run_grid(const Values& values);
Status run_info(const Values& values);
Status run_lightmap(const Values& values);
Status run_lppv(const Values& values);
Status run_merge(const Values& values);
Status run_meshball(const Values& values);
Status run_plan(const Values& values);
Status run_prune(const Values& values);
Status run_query(const Values& values);
Status run_reflect(const Values& values);
Status run_relight(const Values& values);
Status run_render(const Values& values);
Status run_restore(const Values& values);  // only with TETRALIGHT_BUILD_SERVER
Status run_serve(const Values& values);    // only with TETRALIGHT_BUILD_SERVER
Status run_submit(const Values& values);
Status run_task(const Values& values);
Status run_tetrahedralize(const Values& values);
Status run_unwrap(const Values& values);
Status run_validate(const Values& values);
Status run_verify(const Values& values);
Status run_world(const Values& values);

struct Command {
    const settings::Table* table;
    Status (*run)(const Values& values);
};

/// Those of this build.
[[nodiscard]] std::span<const Command> commands();

/// Null if this build has no such command.
[[nodiscard]] const Command* find_command(std::string_view name);

}  // namespace tetralight::cli
