// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/position_handler.h>

#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/position_text.h>

namespace tetralight::cli {
namespace {

constexpr const char* kAxes = "xyz";

/// Why a document is no JSON. One of one line needs no line.
std::string reason_of(const std::exception& exception, PositionHandler::Document document) {
    constexpr size_t kLongest = 160;
    std::string message = json_error_reason(exception);
    const std::string line = "line 1, ";
    const size_t found = message.find(line);
    if (document == PositionHandler::Document::Position && found != message.npos) {
        message.erase(found, line.size());
    }
    return message.size() <= kLongest ? message : message.substr(0, kLongest) + "...";
}

}  // namespace

bool PositionHandler::number_integer(int64_t number) {
    return coordinate(static_cast<float>(number)) || value(str_cat(number));
}

bool PositionHandler::number_unsigned(uint64_t number) {
    return coordinate(static_cast<float>(number)) || value(str_cat(number));
}

/// The digits go straight to float, as those of text do: by way of double they may round twice.
bool PositionHandler::number_float(double /*number*/, const std::string& digits) {
    if (is_ignored()) return true;
    const char axis = kAxes[coordinate_count_ % 3];
    size_t length = 0;
    const auto number = parse_coordinate(digits, axis, length);
    if (number) return coordinate(*number) || value(shown(digits));
    return place_ == Place::Coordinates ? fail(number.error().message) : value(shown(digits));
}

bool PositionHandler::is_ignored() const {
    return ignored_depth_ > 0 || (place_ == Place::Object && !is_position_next_);
}

/// False: a number has no place here.
bool PositionHandler::coordinate(float number) {
    if (is_ignored()) return true;
    if (place_ != Place::Coordinates || coordinate_count_ == 3) return false;
    position_[coordinate_count_++] = number;
    return true;
}

/// A value that is wrong unless it belongs to an ignored member.
bool PositionHandler::value(std::string_view shown_value) {
    if (is_ignored()) return true;
    const std::string what = str_cat(" (", shown(shown_value), ")");
    if (place_ == Place::Coordinates) {
        if (coordinate_count_ == 3) return fail("has more than three numbers");
        return fail(str_cat(kAxes[coordinate_count_], " is not a number", what));
    }
    if (place_ == Place::Object) return fail("\"position\" is not [x, y, z]" + what);
    if (place_ == Place::Document && document_ == Document::Array) {
        return fail("is not an array of positions" + what);
    }
    return fail("is neither [x, y, z] nor {\"position\": [x, y, z]}" + what);
}

bool PositionHandler::fail(const Message& message) {
    error_ = Error{ErrorCode::Corrupt, "positions", "", message};
    if (is_in_array_) error_ = error_.in(str_cat("position ", index_));
    return false;
}

/// The position is complete.
bool PositionHandler::take() {
    place_ = is_in_array_ ? Place::Array : Place::Document;
    ++index_;
    return take_(position_);
}

bool PositionHandler::begin_coordinates() {
    place_ = Place::Coordinates;
    coordinate_count_ = 0;
    return true;
}

bool PositionHandler::start_object(size_t /*size*/) {
    if (is_ignored()) {
        ++ignored_depth_;
        return true;
    }
    const bool is_position =
        place_ == Place::Array || (place_ == Place::Document && document_ == Document::Position);
    if (!is_position) return value("an object");
    place_ = Place::Object;
    is_in_object_ = true;
    is_position_next_ = has_position_ = false;
    return true;
}

bool PositionHandler::key(std::string& name) {
    if (ignored_depth_ > 0) return true;
    is_position_next_ = name == "position";
    if (is_position_next_ && has_position_) return fail("key \"position\" is given twice");
    return true;
}

bool PositionHandler::end_object() {
    if (ignored_depth_ > 0) {
        --ignored_depth_;
        return true;
    }
    if (!has_position_) return fail("has no \"position\"");
    is_in_object_ = false;
    return take();
}

bool PositionHandler::start_array(size_t /*size*/) {
    if (is_ignored()) {
        ++ignored_depth_;
        return true;
    }
    if (place_ == Place::Coordinates) return value("an array");
    if (place_ != Place::Document || document_ == Document::Position) return begin_coordinates();
    place_ = Place::Array;
    is_in_array_ = true;
    return true;
}

bool PositionHandler::end_array() {
    if (ignored_depth_ > 0) {
        --ignored_depth_;
        return true;
    }
    if (place_ == Place::Array) {
        is_in_array_ = false;
        return true;
    }
    if (coordinate_count_ < 3) {
        return fail(str_cat("has ", coordinate_count_,
                            coordinate_count_ == 1 ? " number" : " numbers", ", not three"));
    }
    if (!is_in_object_) return take();
    place_ = Place::Object;  // what follows in it may yet be wrong
    has_position_ = true;
    is_position_next_ = false;
    return true;
}

bool PositionHandler::parse_error(size_t /*byte*/, const std::string& token,
                                  const nlohmann::json::exception& exception) {
    constexpr int kNumberOverflow = 406;
    if (exception.id == kNumberOverflow && !is_ignored()) return number_float(0.0, token);
    return fail(reason_of(exception, document_));
}

}  // namespace tetralight::cli
