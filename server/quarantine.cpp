// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/quarantine.h>

#include <sys/stat.h>

#include <filesystem>

#include <tetralight/base/system_error.h>
#include <tetralight/server/folders.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

/// Reads "volumes-ID.probes", also behind "unknown-" and a number.
void find_id(Quarantined& entry) {
    for (const Kind kind : kKinds) {
        const size_t begin = entry.name.rfind(std::string(name_of(kind)) + "-");
        if (begin == std::string::npos) continue;
        const fs::path file = entry.name.substr(begin + std::string(name_of(kind)).size() + 1);
        if (!is_id(file.stem().string()) || file.extension() != extension_of(kind)) continue;
        entry.kind = kind;
        entry.id = file.stem().string();
    }
}

}  // namespace

std::vector<Quarantined> list_quarantine(const std::string& folder) {
    std::vector<Quarantined> all;
    std::error_code error;
    for (const std::string& name : names_in(folder, error)) {
        struct stat status = {};
        if (::lstat((folder + "/" + name).c_str(), &status) != 0) continue;  // taken back meanwhile
        Quarantined one{.name = name,
                        .bytes = static_cast<uint64_t>(status.st_size),
                        .time = static_cast<double>(status.st_mtim.tv_sec)};
        if (S_ISREG(status.st_mode)) find_id(one);
        all.push_back(std::move(one));
    }
    if (error) {
        throw storage_problem({error_code_of_errno(error.value()),
                               "quarantine: cannot be read (" + error.message() + ")"});
    }
    return all;
}

std::optional<Quarantined> find_quarantined(const std::string& folder, const std::string& name) {
    for (Quarantined& entry : list_quarantine(folder)) {
        if (entry.name == name) return std::move(entry);
    }
    return std::nullopt;
}

}  // namespace tetralight::server
