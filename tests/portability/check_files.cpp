// SPDX-License-Identifier: Apache-2.0
#include "tests/portability/check_files.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>

#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/base/file_writer.h>
#include <tetralight/runtime/tetralight.h>

namespace tetralight::portability {
namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

/// The files of a folder, by the system's own names.
std::vector<std::u8string> names_in(const std::string& folder) {
    std::vector<std::u8string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.push_back(entry.path().filename().u8string());
    }
    return names;
}

class FileCheck {
  public:
    explicit FileCheck(std::string folder) : folder_(std::move(folder)) {}

    std::vector<std::string> run() {
        replace_a_file();
        keep_the_old_file();
        use_names_of_other_scripts();
        map_a_file();
        replace_a_mapped_file();
        name_what_is_missing();
        write_to_a_long_path();
        write_through_a_link();
        refuse_paths_that_are_not_utf8();
        expect(names_in(folder_).size() == file_count_, "a temporary file remains");
        return std::move(wrong_);
    }

  private:
    void expect(bool is_right, std::string what) {
        if (!is_right) wrong_.push_back(std::move(what));
    }

    [[nodiscard]] std::string path(std::string_view name) const {
        return folder_ + "/" + std::string(name);
    }

    void expect_text(const std::string& path, std::string_view text, const char* what) {
        const auto bytes = read_file(path);
        expect(bytes && std::ranges::equal(*bytes, bytes_of(text)), what);
    }

    void expect_error(const Error& error, ErrorCode code, std::string_view text) {
        expect(error.code == code && error_text(error).find(text) != std::string::npos,
               "unexpected error: " + error_text(error));
    }

    void replace_a_file() {
        expect(bool(write_file(path("a"), bytes_of("first"))), "a file cannot be written");
        expect_text(path("a"), "first", "a file has other bytes than were written");
        const std::vector pieces{bytes_of("sec"), bytes_of("ond")};
        expect(bool(write_compared_file(path("a"), pieces)), "a file cannot be replaced");
        expect_text(path("a"), "second", "a file was not replaced");
        ++file_count_;
    }

    void keep_the_old_file() {
        {
            auto writer = FileWriter::open(path("a"));
            expect(writer && writer->write(bytes_of("third")),
                   "a file cannot be written in pieces");
        }
        expect_text(path("a"), "second", "a file without commit replaced the old one");
        auto writer = FileWriter::open(path("a"));
        const auto other = bytes_of("other");
        const auto status = writer && writer->write(bytes_of("third"))
                                ? writer->commit(std::span(&other, 1))
                                : Status(Ok{});
        expect(!status && status.error().code == ErrorCode::Corrupt, "other bytes were accepted");
        expect_text(path("a"), "second", "a failed write replaced the old file");
    }

    void use_names_of_other_scripts() {
        const std::u8string name = u8"свет_光_é";
        const std::string file = path({reinterpret_cast<const char*>(name.data()), name.size()});
        expect(bool(write_file(file, bytes_of("light"))), "a name of another script is refused");
        expect_text(file, "light", "a file with a name of another script cannot be read");
        const auto names = names_in(folder_);
        expect(std::ranges::find(names, name) != names.end(), "the system has another name");
        ++file_count_;
    }

    void map_a_file() {
        auto mapped = MappedFile::open(path("a"));
        expect(mapped && std::ranges::equal(mapped->bytes(), bytes_of("second")),
               "a mapped file has other bytes");
        if (mapped) mapped->release_pages();
        expect(mapped && std::ranges::equal(mapped->bytes(), bytes_of("second")),
               "a mapped file has other bytes after its pages were released");
        expect(bool(write_file(path("empty"), bytes_of(""))), "an empty file cannot be written");
        const auto empty = MappedFile::open(path("empty"));
        expect(empty && empty->bytes().empty(), "an empty file cannot be mapped");
        ++file_count_;
    }

    /// Windows refuses that. The mapping keeps its bytes in any case.
    void replace_a_mapped_file() {
        const auto mapped = MappedFile::open(path("a"));
        const auto status = write_file(path("a"), bytes_of("newest"));
        expect(mapped && std::ranges::equal(mapped->bytes(), bytes_of("second")),
               "a mapping changed when its file was replaced");
        if (status) {
            expect_text(path("a"), "newest", "a mapped file was not replaced");
        } else {
            expect_error(status.error(), ErrorCode::Unavailable, "cannot write (");
            expect_text(path("a"), "second", "a failed write replaced a mapped file");
        }
    }

    void name_what_is_missing() {
        const std::string missing = path("missing.probes");
        expect_error(read_file(missing).error(), ErrorCode::NotFound, missing + ": cannot open (");
        expect_error(MappedFile::open(missing).error(), ErrorCode::NotFound, missing);
        expect_error(read_file(folder_).error(), ErrorCode::InvalidArgument, "is a folder");
        expect_error(write_file(path("a/b"), bytes_of("x")).error(), ErrorCode::NotFound,
                     path("a/b") + ": cannot write (");
        expect(!write_file(folder_, bytes_of("x")), "a folder was replaced by a file");
        tetralight_error error = {};
        tetralight_volume* volume = nullptr;
        expect(tetralight_open(missing.c_str(), &volume, &error) == TETRALIGHT_BAD_FILE,
               std::string("the C API has another status for a missing file: ") + error.message);
    }

    /// Windows takes more than 260 characters in a special form of path only.
    void write_to_a_long_path() {
        std::string folder = path("long");
        for (int i = 0; i < 4; ++i) folder += "/" + std::string(60, 'x');
        std::error_code failure;
        fs::create_directories(folder, failure);
        if (failure) {  // this system has no such folders
            fs::remove_all(path("long"), failure);
            return;
        }
        const std::string file = folder + "/" + std::string(60, 'y');
        const auto status = write_file(file, bytes_of("deep"));
        expect(bool(status), "a long path is refused");
        expect_text(file, "deep", "a file with a long path cannot be read");
        ++file_count_;
    }

    /// Writing through a link keeps the link and creates the file that it names.
    void write_through_a_link() {
        const std::string link = path("link");
        std::error_code failure;
        fs::remove(link, failure);
        fs::remove(path("end"), failure);
        fs::create_symlink("end", link, failure);
        if (failure) return;  // this system, or this user, has no links
        for (const char* text : {"new", "newer"}) {
            expect(bool(write_file(link, bytes_of(text))), "a file cannot be written by its link");
            expect_text(path("end"), text,
                        "what a link leads to has other bytes than were written");
        }
        expect(fs::is_symlink(link), "a link was replaced");
        file_count_ += 2;
    }

    /// Elsewhere than on Windows a path is bytes, and such a file may exist.
    void refuse_paths_that_are_not_utf8() {
        const auto read = read_file(path("\xff"));
        expect(!read && (read.error().code == ErrorCode::InvalidArgument ||
                         read.error().code == ErrorCode::NotFound),
               "a path that is not UTF-8 was read");
    }

    std::string folder_;
    size_t file_count_ = 0;
    std::vector<std::string> wrong_;
};

}  // namespace

std::vector<std::string> check_files(const std::string& folder) {
    return FileCheck(folder).run();
}

}  // namespace tetralight::portability
