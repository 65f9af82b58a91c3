// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/paths.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include <tetralight/base/file_writer.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/validators.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

CLI::Validator has_extension(const std::string& extension) {
    const auto check = [extension](const std::string& path) -> std::string {
        const std::string found = fs::path(path).extension().string();
        const auto known = CLI::detail::split(extension, ',');
        const bool is_known = std::ranges::count(known, CLI::detail::to_lower(found)) > 0;
        if (found.empty() || is_known) return "";
        return str_cat("cannot write \"", found, "\" files; the extension may be ", extension,
                       ", or none");
    };
    return {check, ""};
}

Error cannot_write(const std::string& path, const std::string& why) {
    return {path + ": cannot write (" + why + ")"};
}

/// Whether a path is another name of an open file, as /dev/stdout is: a new file renamed over it
/// would take the place of what the shell redirected to.
bool names_open_file(const fs::path& path) {
    std::error_code error;
    const auto is_in_proc = [](const fs::path& p) { return p.string().starts_with("/proc/"); };
    return is_in_proc(fs::read_symlink(path, error)) ||
           is_in_proc(fs::canonical(path.parent_path(), error));
}

/// What stands at the path and is neither a regular file nor a character device.
std::string what_is_there(const fs::path& path) {
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

CLI::Option* add_path(CLI::App& command, const std::string& name, std::string& path,
                      const std::string& help) {
    return command.add_option(name, path, help)->check(not_empty("path"));
}

CLI::Option* add_paths(CLI::App& command, const std::string& name, std::vector<std::string>& paths,
                       const std::string& help) {
    return command.add_option(name, paths, help)->check(not_empty("path"));
}

CLI::Option* add_file_to_write(CLI::App& command, const std::string& name, std::string& path,
                               const std::string& extension, const std::string& help) {
    return add_path(command, name, path, help + " (" + extension + "; - = stdout)")
        ->check(has_extension(extension));
}

CLI::Option* add_output(CLI::App& command, std::string& path, const std::string& extension,
                        const std::string& help) {
    return add_file_to_write(command, "-o,--output", path, extension, help)->required();
}

bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error)) return true;
    const fs::path first = fs::weakly_canonical(fs::absolute(a, error), error);
    return first == fs::weakly_canonical(fs::absolute(b, error), error);
}

Status check_output(const std::string& path, const std::vector<std::string>& inputs) {
    std::error_code error;
    for (const std::string& input : inputs) {
        if (!fs::is_regular_file(input, error) || !fs::equivalent(input, path, error)) continue;
        return Error{path + ": is an input of this command and would be lost; write elsewhere"};
    }
    if (path == "-") return Ok{};
    if (names_open_file(path)) {
        return cannot_write(path, "names an open file; write to - for stdout");
    }
    if (const std::string problem = what_is_there(path); !problem.empty()) {
        return cannot_write(path, problem);
    }
    if (fs::is_character_file(path, error)) return Ok{};  // /dev/null, a terminal
    const auto target = follow_links(path);
    if (!target) return target.error();
    const fs::path folder =
        fs::path(*target).has_parent_path() ? fs::path(*target).parent_path() : ".";
    if (!fs::is_directory(folder, error)) {
        return cannot_write(path, "there is no folder " + folder.string());
    }
    if (::access(folder.c_str(), W_OK) != 0) {
        return cannot_write(path, "no permission in " + folder.string());
    }
    return Ok{};
}

}  // namespace tetralight::cli
