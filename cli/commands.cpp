// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/commands.h>

#include <algorithm>

namespace tetralight::cli {
namespace {

constexpr Command kCommands[] = {
    {&settings::kGrid, run_grid},         {&settings::kBake, run_bake},
    {&settings::kLightmap, run_lightmap}, {&settings::kUnwrap, run_unwrap},
    {&settings::kReflect, run_reflect},   {&settings::kBakeAll, run_bake_all},
    {&settings::kPlan, run_plan},         {&settings::kTask, run_task},
    {&settings::kCollect, run_collect},   {&settings::kSubmit, run_submit},
    {&settings::kExport, run_export},     {&settings::kMerge, run_merge},
    {&settings::kPrune, run_prune},       {&settings::kTetrahedralize, run_tetrahedralize},
    {&settings::kWorld, run_world},       {&settings::kQuery, run_query},
    {&settings::kRelight, run_relight},   {&settings::kLppv, run_lppv},
    {&settings::kRender, run_render},     {&settings::kMeshball, run_meshball},
    {&settings::kExplain, run_explain},   {&settings::kInfo, run_info},
    {&settings::kValidate, run_validate}, {&settings::kCheckLeaks, run_check_leaks},
    {&settings::kVerify, run_verify},
#ifdef TETRALIGHT_HAS_SERVER
    {&settings::kServe, run_serve},       {&settings::kFsck, run_fsck},
    {&settings::kBackup, run_backup},     {&settings::kRestore, run_restore},
#endif
};

}  // namespace

std::span<const Command> commands() {
    return kCommands;
}

const Command* find_command(std::string_view name) {
    const auto found = std::ranges::find(
        kCommands, name, [](const Command& command) { return command.table->command; });
    return found == std::end(kCommands) ? nullptr : &*found;
}

}  // namespace tetralight::cli
