// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/position_json.h>

#include <array>
#include <cstdint>
#include <istream>
#include <optional>
#include <streambuf>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/position_handler.h>

namespace tetralight::cli {
namespace {

/// What the JSON parser reads from.
class ReaderBuffer : public std::streambuf {
  public:
    explicit ReaderBuffer(ByteReader& reader) : reader_(reader) {}

    [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  protected:
    int_type underflow() override {
        const auto count = reader_.read(memory_);
        if (!count) error_ = count.error();
        if (!count || *count == 0) return traits_type::eof();
        setg(memory_.data(), memory_.data(), memory_.data() + *count);
        return traits_type::to_int_type(memory_[0]);
    }

  private:
    ByteReader& reader_;
    std::optional<Error> error_;
    std::array<char, size_t{1} << 16> memory_;
};

}  // namespace

Status read_json(ByteReader& reader, PositionChunks& chunks) {
    ReaderBuffer buffer(reader);
    std::istream stream(&buffer);
    Status answered = Ok{};
    PositionHandler handler(PositionHandler::Document::Array, chunks.normals(),
                            [&](const QueryPosition& position) {
                                answered = chunks.add(position);
                                return static_cast<bool>(answered);
                            });
    const bool is_parsed = nlohmann::json::sax_parse(stream, &handler);
    if (!answered) return answered;
    if (buffer.error()) return *buffer.error();
    if (is_parsed) return Ok{};
    return handler.error().in(reader.name());
}

Result<QueryPosition> parse_json_position(std::string_view line, Normals normals) {
    QueryPosition position;
    PositionHandler handler(PositionHandler::Document::Position, normals,
                            [&](const QueryPosition& found) {
                                position = found;
                                return true;
                            });
    if (nlohmann::json::sax_parse(line.begin(), line.end(), &handler)) return position;
    return handler.error();
}

}  // namespace tetralight::cli
