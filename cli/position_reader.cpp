// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/position_reader.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/position_json.h>
#include <tetralight/cli/position_text.h>

namespace tetralight::cli {
namespace {

constexpr size_t kLongestLine = size_t{1} << 18;

/// The position on a line; none if the line is blank.
using ParsedLine = Result<std::optional<QueryPosition>>;

bool is_blank(std::string_view line) {
    return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

ParsedLine parse_text_line(std::string_view line, Normals normals) {
    const std::string_view words = line.substr(0, line.find('#'));
    if (is_blank(words)) return std::optional<QueryPosition>();
    const auto position = parse_position(words, normals);
    return position ? ParsedLine(*position) : position.error();
}

/// The first fields of a line of CSV: three, or six with normals.
ParsedLine parse_csv_line(std::string_view line, Normals normals) {
    size_t end = line.find(',');
    for (int field = 1; field < number_count(normals) && end != line.npos; ++field) {
        end = line.find(',', end + 1);
    }
    return parse_text_line(line.substr(0, end), normals);
}

/// True if a line of text is a CSV header, as that of our own CSV.
bool is_csv_header(std::string_view line, Normals normals) {
    const std::string_view names = normals == Normals::Given ? "x,y,z,nx,ny,nz" : "x,y,z";
    if (!line.starts_with(names)) return false;
    const std::string_view rest = line.substr(names.size());
    return is_blank(rest) || rest.starts_with(',');
}

ParsedLine parse_json_line(std::string_view line, Normals normals) {
    if (is_blank(line)) return std::optional<QueryPosition>();
    const auto position = parse_json_position(line, normals);
    return position ? ParsedLine(*position) : position.error();
}

using ParseLine = ParsedLine (*)(std::string_view line, Normals normals);

/// Parses line after line; the first one may have a mark of UTF-8, or be a header.
class LineParser {
  public:
    LineParser(ParseLine parse, Normals normals) : parse_(parse), normals_(normals) {}

    ParsedLine operator()(std::string_view line) {
        constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
        if (++number_ > 1) return parse_(line, normals_);
        if (line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
        if (parse_ != parse_text_line || !is_csv_header(line, normals_)) {
            return parse_(line, normals_);
        }
        parse_ = parse_csv_line;
        return std::optional<QueryPosition>();
    }

    /// Of the line that was parsed last, from 1.
    [[nodiscard]] uint64_t number() const { return number_; }

  private:
    ParseLine parse_;
    Normals normals_;
    uint64_t number_ = 0;
};

Status read_lines(ByteReader& reader, PositionChunks& chunks, ParseLine parse_line) {
    LineParser parse(parse_line, chunks.normals());
    std::vector<char> memory(kLongestLine);
    size_t held = 0;
    const auto error_in = [&](uint64_t number, const Error& error) {
        return error.in(str_cat(reader.name(), ":", number));
    };
    while (true) {
        const auto count = reader.read(std::span(memory).subspan(held));
        if (!count) return count.error();
        std::string_view rest(memory.data(), held + *count);
        const bool is_end = *count == 0;
        for (size_t search = held; !rest.empty(); search = 0) {
            const size_t length = rest.find('\n', search);
            if (length == std::string_view::npos && !is_end) break;
            const std::string_view line = rest.substr(0, length);
            const auto position = parse(line);
            if (!position) return error_in(parse.number(), position.error());
            if (*position) {
                if (auto status = chunks.add(**position); !status) return status;
            }
            rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        }
        if (is_end) return Ok{};
        held = rest.size();
        if (held == kLongestLine) {
            return error_in(parse.number() + 1,
                            Error{ErrorCode::Corrupt,
                                  str_cat("the line is longer than ", kLongestLine, " bytes")});
        }
        std::memmove(memory.data(), rest.data(), held);
    }
}

Status read_raw(ByteReader& reader, PositionChunks& chunks) {
    static_assert(std::endian::native == std::endian::little);
    const auto count_of_numbers = static_cast<size_t>(number_count(chunks.normals()));
    const size_t record_size = count_of_numbers * sizeof(float);
    std::vector<char> memory(record_size << 14);
    size_t held = 0;
    uint64_t record = 0;
    while (true) {
        const auto count = reader.read(std::span(memory).subspan(held));
        if (!count) return count.error();
        if (*count == 0) break;
        held += *count;
        size_t done = 0;
        for (; done + record_size <= held; done += record_size, ++record) {
            std::array<float, 6> numbers{};
            std::memcpy(numbers.data(), memory.data() + done, record_size);
            const auto position = make_query_position(std::span(numbers).first(count_of_numbers));
            if (!position) {
                return position.error().in(str_cat(reader.name(), ": record ", record));
            }
            if (auto status = chunks.add(*position); !status) return status;
        }
        held -= done;
        std::memmove(memory.data(), memory.data() + done, held);
    }
    if (held == 0) return Ok{};
    return Error{
        ErrorCode::Corrupt,
        str_cat(reader.name(), ": ends at byte ", record_size * record + held, ", ", held,
                held == 1 ? " byte" : " bytes", " into record ", record, "; records are ",
                record_size, " bytes, ",
                chunks.normals() == Normals::Given ? "x y z nx ny nz" : "x y z", " as float32")};
}

Status read_all(ByteReader& reader, PositionFormat format, PositionChunks& chunks) {
    switch (format) {
        case PositionFormat::JsonArray:
            return read_json(reader, chunks);
        case PositionFormat::JsonLines:
            return read_lines(reader, chunks, parse_json_line);
        case PositionFormat::Raw:
            return read_raw(reader, chunks);
        case PositionFormat::Text:
            break;
    }
    return read_lines(reader, chunks, parse_text_line);
}

}  // namespace

Status read_positions(ByteReader& reader, PositionFormat format, PositionChunks& chunks) {
    reader.before_wait([&] { return chunks.flush(); });
    const Status status = read_all(reader, format, chunks);
    reader.before_wait({});
    const Status flushed = chunks.flush();
    return status ? flushed : status;
}

}  // namespace tetralight::cli
