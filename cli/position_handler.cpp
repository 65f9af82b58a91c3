// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/position_handler.h>

#include <span>

#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/position_text.h>

namespace tetralight::cli {
namespace {

constexpr std::string_view kPositionForm = R"("position": [x, y, z])";
constexpr std::string_view kNormalForm = R"("normal": [nx, ny, nz])";

const char* number_word(int count) {
    return count == 3 ? "three" : "six";
}

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
    const char* name = kNumberNames[(first_ + count_) % 6];
    size_t length = 0;
    const auto number = parse_coordinate(digits, name, length);
    if (number) return coordinate(*number) || value(shown(digits));
    return place_ == Place::Coordinates ? fail(number.error().message) : value(shown(digits));
}

bool PositionHandler::is_ignored() const {
    return ignored_depth_ > 0 || (place_ == Place::Object && next_ == Member::Other);
}

/// False: a number has no place here.
bool PositionHandler::coordinate(float number) {
    if (is_ignored()) return true;
    if (place_ != Place::Coordinates || count_ == expected_) return false;
    numbers_[static_cast<size_t>(first_ + count_++)] = number;
    return true;
}

/// What a message about the open array is about: "normal " or nothing.
std::string PositionHandler::subject() const {
    return is_in_object_ && first_ == 3 ? "normal " : "";
}

/// A value that is wrong unless it belongs to an ignored member.
bool PositionHandler::value(std::string_view shown_value) {
    if (is_ignored()) return true;
    const std::string what = str_cat(" (", shown(shown_value), ")");
    if (place_ == Place::Coordinates) {
        if (count_ == expected_) {
            return fail(str_cat(subject(), "has more than ", number_word(expected_), " numbers"));
        }
        return fail(str_cat(kNumberNames[first_ + count_], " is not a number", what));
    }
    if (place_ == Place::Object && next_ == Member::Normal) {
        return fail("\"normal\" is not [nx, ny, nz]" + what);
    }
    if (place_ == Place::Object) return fail("\"position\" is not [x, y, z]" + what);
    if (place_ == Place::Document && document_ == Document::Array) {
        return fail("is not an array of positions" + what);
    }
    if (normals_ == Normals::Given) {
        return fail(str_cat("is neither [x, y, z, nx, ny, nz] nor {", kPositionForm, ", ",
                            kNormalForm, "}", what));
    }
    return fail(str_cat("is neither [x, y, z] nor {", kPositionForm, "}", what));
}

bool PositionHandler::fail(const Message& message) {
    error_ = Error{ErrorCode::Corrupt, "positions", "", message};
    if (is_in_array_) error_ = error_.in(str_cat("position ", index_));
    return false;
}

/// The position is complete.
bool PositionHandler::take() {
    const auto used = std::span(numbers_).first(static_cast<size_t>(number_count(normals_)));
    const auto position = make_query_position(used);
    if (!position) return fail(position.error().message);
    place_ = is_in_array_ ? Place::Array : Place::Document;
    ++index_;
    return take_(*position);
}

/// Numbers from `first` on follow, as many as `count`.
bool PositionHandler::begin_coordinates(int first, int count) {
    place_ = Place::Coordinates;
    first_ = first;
    expected_ = count;
    count_ = 0;
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
    next_ = Member::Other;
    has_position_ = has_normal_ = false;
    return true;
}

bool PositionHandler::key(std::string& name) {
    if (ignored_depth_ > 0) return true;
    next_ = Member::Other;
    if (name == "position") next_ = Member::Position;
    if (name == "normal" && normals_ == Normals::Given) next_ = Member::Normal;
    const bool is_there =
        (next_ == Member::Position && has_position_) || (next_ == Member::Normal && has_normal_);
    return is_there ? fail(str_cat("key \"", name, "\" is given twice")) : true;
}

bool PositionHandler::end_object() {
    if (ignored_depth_ > 0) {
        --ignored_depth_;
        return true;
    }
    if (!has_position_) return fail("has no \"position\"");
    if (!has_normal_ && normals_ == Normals::Given) return fail("has no \"normal\"");
    is_in_object_ = false;
    return take();
}

bool PositionHandler::start_array(size_t /*size*/) {
    if (is_ignored()) {
        ++ignored_depth_;
        return true;
    }
    if (place_ == Place::Coordinates) return value("an array");
    if (place_ == Place::Object) return begin_coordinates(next_ == Member::Normal ? 3 : 0, 3);
    if (place_ != Place::Document || document_ == Document::Position) {
        return begin_coordinates(0, number_count(normals_));
    }
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
    if (count_ < expected_) {
        return fail(str_cat(subject(), "has ", count_, count_ == 1 ? " number" : " numbers",
                            ", not ", number_word(expected_)));
    }
    if (!is_in_object_) return take();
    place_ = Place::Object;  // what follows in it may yet be wrong
    (first_ == 0 ? has_position_ : has_normal_) = true;
    next_ = Member::Other;
    return true;
}

bool PositionHandler::parse_error(size_t /*byte*/, const std::string& token,
                                  const nlohmann::json::exception& exception) {
    constexpr int kNumberOverflow = 406;
    if (exception.id == kNumberOverflow && !is_ignored()) return number_float(0.0, token);
    return fail(reason_of(exception, document_));
}

}  // namespace tetralight::cli
