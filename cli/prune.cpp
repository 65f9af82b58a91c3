// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/pipeline/bake_store.h>

namespace tetralight::cli {

Status run_prune(const Values& values) {
    const std::string folder = values.text("store");
    const CommonOptions common(values);
    if (!BakeStore::is_store(folder)) {
        return Error{ErrorCode::NotFound, "store", folder,
                     str_cat(folder, ": is not a store of probes (bake --store)")};
    }
    auto store = BakeStore::open(folder);
    if (!store) return store.error();
    const auto limit = static_cast<uint64_t>(values.number("limit") * 1e9);
    const StoreSize size = store->prune(limit);
    if (size.kept > limit) {
        return Error{ErrorCode::Unavailable, "store", folder,
                     str_cat(folder, ": files cannot be deleted; ", size.kept, " bytes are left")};
    }
    common.print({{"store", folder}, {"kept_bytes", size.kept}, {"deleted_bytes", size.deleted}},
                 str_cat(folder, ": deleted ", magnitude(static_cast<double>(size.deleted)),
                         "B, kept ", magnitude(static_cast<double>(size.kept)), "B"));
    return Ok{};
}

}  // namespace tetralight::cli
