// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/viewer_files.h>

#include <algorithm>
#include <filesystem>

#include <tetralight/base/file.h>
#include <tetralight/base/hash/sha256.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

namespace fs = std::filesystem;

constexpr size_t kTagLength = 32;

Response how_to_get_it() {
    return {.content_type = "text/plain; charset=utf-8",
            .body = std::string(
                "This is tetralight serve. It answers requests (/openapi.json has all of them), "
                "but its viewer was not found:\nbuild it with `./run build viewer` and start the "
                "server again, or name its folder with --viewer DIR.\n")};
}

Problem nothing_there(const Request& request) {
    return {404, "no_such_path", "there is nothing at this path", "path", request.path};
}

const char* media_type_of(const std::string& name) {
    static const std::map<std::string, const char*> kTypes{
        {".html", "text/html; charset=utf-8"},
        {".js", "text/javascript; charset=utf-8"},
        {".mjs", "text/javascript; charset=utf-8"},
        {".css", "text/css; charset=utf-8"},
        {".json", "application/json"},
        {".svg", "image/svg+xml"},
        {".png", "image/png"},
        {".ico", "image/x-icon"},
        {".wasm", "application/wasm"},
        {".woff2", "font/woff2"}};
    const auto found = kTypes.find(fs::path(name).extension().string());
    return found == kTypes.end() ? "application/octet-stream" : found->second;
}

/// True for "assets/index-DkD0Xn2v.js": the bundler names such files by a hash of their bytes. A
/// word of eight small letters is not taken for a hash.
bool has_hash_in_name(const std::string& name) {
    constexpr size_t kHashLength = 8;
    const std::string stem = fs::path(name).stem().string();
    if (!name.starts_with("assets/") || stem.size() < kHashLength + 2) return false;
    const std::string_view hash = std::string_view(stem).substr(stem.size() - kHashLength);
    const auto is_upper_or_digit = [](char c) {
        return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    };
    const auto is_base64 = [&](char c) {
        return is_upper_or_digit(c) || (c >= 'a' && c <= 'z') || c == '-' || c == '_';
    };
    return stem[stem.size() - kHashLength - 1] == '-' && std::ranges::all_of(hash, is_base64) &&
           std::ranges::any_of(hash, is_upper_or_digit);
}

/// The answer without its body.
Response page_response(const std::string& name, const std::string& tag) {
    constexpr const char* kForEver = "public, max-age=31536000, immutable";
    return {.content_type = media_type_of(name),
            .headers = {{"Content-Security-Policy",
                         "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' "
                         "blob:; style-src 'self'; script-src 'self' 'wasm-unsafe-eval'; "
                         "worker-src 'self' blob:; object-src 'none'; base-uri 'none'; "
                         "form-action 'none'; frame-ancestors 'none'"},
                        {"Referrer-Policy", "no-referrer"},
                        {"Cache-Control", has_hash_in_name(name) ? kForEver : "no-cache"},
                        {"Vary", "Accept-Encoding"},
                        {"ETag", tag}}};
}

}  // namespace

/// Null if there is no such file.
std::shared_ptr<const ViewerFiles::File> ViewerFiles::find(const std::string& path) const {
    std::error_code error;
    const auto stamp = stamp_of(path);
    if (!stamp || !fs::is_regular_file(path, error)) return nullptr;
    const std::lock_guard lock(mutex_);
    auto& known = files_[path];
    if (known && known->stamp == *stamp) return known;
    auto bytes = read_file(path);
    if (!bytes) return nullptr;
    const std::string tag = sha256_hex(*bytes).substr(0, kTagLength);
    known = std::make_shared<const File>(File{*stamp, tag, Body(std::move(*bytes))});
    return known;
}

/// Resolves links and `..`; the result must lie in the folder.
std::shared_ptr<const ViewerFiles::File> ViewerFiles::find_in_folder(
    const std::string& name) const {
    std::error_code error;
    const fs::path root = fs::canonical(folder_, error);
    if (error) return nullptr;
    const fs::path file = fs::canonical(root / name, error);
    const bool is_inside = !error && file.string().starts_with(root.string() + "/");
    return is_inside ? find(file.string()) : nullptr;
}

Response ViewerFiles::respond(const Request& request) const {
    if (folder_.empty()) return how_to_get_it();
    const std::string name = request.path == "/" ? "index.html" : request.path.substr(1);
    auto file = find_in_folder(name);
    if (!file) throw nothing_there(request);
    std::string tag = "\"" + file->tag + "\"";
    bool is_compressed = false;
    if (accepts_gzip(request.header("accept-encoding"))) {
        const auto compressed = find_in_folder(name + ".gz");
        is_compressed = compressed && compressed->stamp.written >= file->stamp.written;
        if (is_compressed) {
            file = compressed;
            tag = "\"" + file->tag + "-gzip\"";
        }
    }
    Response response = page_response(name, tag);
    if (has_tag(request.header("if-none-match"), tag, TagComparison::Weak)) {
        response.status = 304;
        return response;
    }
    if (is_compressed) response.headers.emplace_back("Content-Encoding", "gzip");
    response.body = file->body;
    return response;
}

}  // namespace tetralight::server
