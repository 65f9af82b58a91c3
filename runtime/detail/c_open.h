// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <new>
#include <span>
#include <string>
#include <utility>

#include <tetralight/base/result.h>
#include <tetralight/runtime/detail/c_arrays.h>
#include <tetralight/runtime/detail/c_errors.h>

// Opens files of every kind for C callers.

namespace tetralight::detail {

/// Moves an opened file into a new handle for the caller.
template <class Handle, class File>
[[nodiscard]] tetralight_status make_handle(Result<File> file, Handle** handle,
                                            tetralight_error* error) {
    if (!file) return finish(file_error(file.error()), error);
    auto* opened = new (std::nothrow) Handle{std::move(*file)};
    if (!opened) return finish({TETRALIGHT_OUT_OF_MEMORY, "no memory for an open file"}, error);
    *handle = opened;
    return succeed(error);
}

/// Opens a path with `open`. `name` is that of the argument `handle`.
template <class Handle, class Open>
[[nodiscard]] tetralight_status open_path(Open open, const char* path, const char* name,
                                          Handle** handle, tetralight_error* error) {
    if (auto wrong = check_pointer("path", path)) return finish(wrong, error);
    if (auto wrong = check_pointer(name, handle)) return finish(wrong, error);
    return make_handle(open(std::string(path)), handle, error);
}

/// Opens a copy of bytes with `open`.
template <class Handle, class Open>
[[nodiscard]] tetralight_status open_bytes(Open open, const void* bytes, size_t size,
                                           const char* name, Handle** handle,
                                           tetralight_error* error) {
    if (auto wrong = check_required("bytes", bytes, 1)) return finish(wrong, error);
    if (auto wrong = check_pointer(name, handle)) return finish(wrong, error);
    if (auto wrong = check_memory("a copy of the file", size)) return finish(wrong, error);
    return make_handle(open(std::span(static_cast<const std::byte*>(bytes), size)), handle, error);
}

}  // namespace tetralight::detail
