// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/paths.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <tetralight/base/file_writer.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

/// Why a file cannot be written, once it is known for which setting.
struct WhyNot {
    const std::string& path;
    const std::string& setting;

    [[nodiscard]] Error operator()(ErrorCode code, const std::string& why) const {
        return {code, setting, path, path + ": cannot write (" + why + ")"};
    }
};

/// True if a path is another name of an open file, as /dev/stdout is: a new file renamed over it
/// would replace what the shell redirected to.
bool names_open_file(const fs::path& path) {
    std::error_code error;
    const auto is_in_proc = [](const fs::path& p) { return p.string().starts_with("/proc/"); };
    return is_in_proc(fs::read_symlink(path, error)) ||
           is_in_proc(fs::canonical(path.parent_path(), error));
}

/// What is at the path if it is neither a regular file nor a character device.
std::string special_file(const fs::path& path) {
    std::error_code error;
    switch (fs::status(path, error).type()) {
        case fs::file_type::directory:
            return "is a folder";
        case fs::file_type::fifo:
            return "is a pipe; write to - and let the shell redirect it";
        case fs::file_type::socket:
            return "is a socket";
        case fs::file_type::block:
            return "is a block device";
        default:
            return "";
    }
}

}  // namespace

bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error)) return true;
    const fs::path first = fs::weakly_canonical(fs::absolute(a, error), error);
    return first == fs::weakly_canonical(fs::absolute(b, error), error);
}

Status check_output(const std::string& path, const std::vector<std::string>& inputs,
                    const std::string& setting) {
    const WhyNot cannot_write{path, setting};
    std::error_code error;
    for (const std::string& input : inputs) {
        if (!fs::is_regular_file(input, error) || !fs::equivalent(input, path, error)) continue;
        return Error{ErrorCode::InvalidArgument, setting, path,
                     path + ": is an input of this command and would be lost; write elsewhere"};
    }
    if (path == "-") return Ok{};
    if (names_open_file(path)) {
        return cannot_write(ErrorCode::InvalidArgument,
                            "names an open file; write to - for stdout");
    }
    if (const std::string problem = special_file(path); !problem.empty()) {
        return cannot_write(ErrorCode::InvalidArgument, problem);
    }
    if (fs::is_character_file(path, error)) return Ok{};  // /dev/null, a terminal
    const auto target = follow_links(path);
    if (!target) return target.error();
    const fs::path folder =
        fs::path(*target).has_parent_path() ? fs::path(*target).parent_path() : ".";
    if (!fs::is_directory(folder, error)) {
        return cannot_write(ErrorCode::NotFound, "there is no folder " + folder.string());
    }
    if (::access(folder.c_str(), W_OK) != 0) {
        return cannot_write(ErrorCode::Unavailable, "no permission in " + folder.string());
    }
    return Ok{};
}

Status check_side_file(const std::string& path, const std::vector<std::string>& others,
                       const std::string& setting) {
    const WhyNot cannot_write{path, setting};
    std::error_code error;
    if (path == "-" || fs::is_character_file(path, error)) {
        return cannot_write(ErrorCode::InvalidArgument, "is not a regular file");
    }
    for (const std::string& other : others) {
        if (other.empty() || other == "-" || !is_same_file(path, other)) continue;
        return Error{ErrorCode::InvalidArgument, setting, path,
                     path + ": is another file of this command and would be lost; write elsewhere"};
    }
    return check_output(path, others, setting);
}

Status make_folder(const std::string& path, const std::string& setting) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (!error) return Ok{};
    // A file in its way stays there.
    const bool is_file = error == std::errc::not_a_directory || error == std::errc::file_exists;
    return Error{is_file ? ErrorCode::InvalidArgument : error_code_of_errno(error.value()), setting,
                 path, str_cat(path, ": cannot be made: ", error.message())};
}

}  // namespace tetralight::cli
