// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include <tetralight/base/result.h>
#include <tetralight/cli/query_position.h>

namespace tetralight::cli {

/// Takes positions out of JSON while it is parsed (nlohmann's SAX interface): the document is not
/// kept.
class PositionHandler {
  public:
    enum class Document : uint8_t { Array, Position };

    /// False: stop.
    using Take = std::function<bool(const QueryPosition&)>;

    PositionHandler(Document document, Normals normals, Take take)
        : document_(document), normals_(normals), take_(std::move(take)) {}

    /// Why parsing ended early, with the position's place in the array.
    [[nodiscard]] const Error& error() const { return error_; }

    // What the parser calls. False ends it.
    bool null() { return value("null"); }

    bool boolean(bool is_true) { return value(is_true ? "true" : "false"); }

    bool number_integer(int64_t number);
    bool number_unsigned(uint64_t number);
    bool number_float(double number, const std::string& digits);

    bool string(std::string& characters) { return value("\"" + characters + "\""); }

    bool binary(nlohmann::json::binary_t& /*bytes*/) { return value("bytes"); }

    bool start_object(size_t size);
    bool key(std::string& name);
    bool end_object();
    bool start_array(size_t size);
    bool end_array();
    bool parse_error(size_t byte, const std::string& token,
                     const nlohmann::json::exception& exception);

  private:
    enum class Place : uint8_t { Document, Array, Object, Coordinates };
    /// Which member of an object comes next.
    enum class Member : uint8_t { Other, Position, Normal };

    [[nodiscard]] bool is_ignored() const;
    bool coordinate(float number);
    bool value(std::string_view shown_value);
    bool fail(const Message& message);
    bool take();
    bool begin_coordinates(int first, int count);
    [[nodiscard]] std::string subject() const;

    Document document_;
    Normals normals_;
    Take take_;
    Error error_;
    Place place_ = Place::Document;
    uint64_t index_ = 0;  ///< of the position
    /// Open arrays and objects inside an ignored value.
    uint64_t ignored_depth_ = 0;
    bool is_in_array_ = false;
    bool is_in_object_ = false;
    Member next_ = Member::Other;  ///< the object's next value
    bool has_position_ = false;    ///< the object
    bool has_normal_ = false;      ///< the object
    // The open array: where its numbers go, how many it has to have, and how many it had.
    int first_ = 0;
    int expected_ = 0;
    int count_ = 0;
    std::array<float, 6> numbers_{};
};

}  // namespace tetralight::cli
