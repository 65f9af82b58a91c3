// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/file_writer.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include <tetralight/base/detail/file_system.h>
#include <tetralight/base/file.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {

Result<std::string> follow_links(const std::string& path) {
    return detail::follow_file_links(path);
}

FileWriter::FileWriter(std::string path, std::unique_ptr<detail::NewFile> file)
    : path_(std::move(path)), file_(std::move(file)) {}

FileWriter::FileWriter(FileWriter&& other) noexcept = default;

FileWriter::~FileWriter() = default;

Result<FileWriter> FileWriter::open(const std::string& path) {
    if (path.empty()) {
        return Error{ErrorCode::InvalidArgument, "", path,
                     shown_path(path) + ": cannot write (the path is empty)"};
    }
    auto file = detail::open_new_file(path);
    if (!file) return file.error();
    return FileWriter(detail::output_name(path), std::move(*file));
}

Status FileWriter::write(std::span<const std::byte> bytes) {
    return file_->write(bytes);
}

namespace {

Result<FileWriter> write_pieces(const std::string& path, FilePieces pieces) {
    auto writer = FileWriter::open(path);
    if (!writer) return writer;
    for (const auto piece : pieces) {
        if (auto status = writer->write(piece); !status) return status.error();
    }
    return writer;
}

}  // namespace

Status write_file(const std::string& path, FilePieces pieces) {
    auto writer = write_pieces(path, pieces);
    if (!writer) return writer.error();
    return writer->commit();
}

Status write_file(const std::string& path, std::span<const std::byte> bytes) {
    return write_file(path, std::span(&bytes, 1));
}

Status write_compared_file(const std::string& path, FilePieces pieces) {
    auto writer = write_pieces(path, pieces);
    if (!writer) return writer.error();
    return writer->commit(pieces);
}

Status FileWriter::commit() {
    if (file_->is_replacement()) {
        if (auto status = file_->sync(); !status) return status;
    }
    return file_->commit();
}

Status FileWriter::commit(FilePieces expected) {
    if (file_->is_replacement()) {
        if (auto status = file_->sync(); !status) return status;
        if (auto status = compare_with(expected); !status) return status;
    }
    return file_->commit();
}

Status FileWriter::compare_with(FilePieces expected) const {
    std::vector<std::byte> block(kComparedBlockSize);  // a mapped file would be in memory twice
    const Error differs{ErrorCode::Corrupt,
                        str_cat(shown_path(path_),
                                ": was not replaced, as other bytes came back than were written")};
    if (auto status = file_->rewind(); !status) return status;
    for (std::span<const std::byte> rest : expected) {
        while (!rest.empty()) {
            const auto wanted = rest.first(std::min(rest.size(), kComparedBlockSize));
            const auto count = file_->read(std::span(block).first(wanted.size()));
            if (!count) return count.error();
            if (*count != wanted.size() || std::memcmp(wanted.data(), block.data(), *count) != 0) {
                return differs;
            }
            rest = rest.subspan(wanted.size());
        }
    }
    const auto more = file_->read(std::span(block).first(1));
    if (!more) return more.error();
    return *more == 0 ? Status(Ok{}) : differs;
}

}  // namespace tetralight
