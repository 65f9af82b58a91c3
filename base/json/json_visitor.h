// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace tetralight {

/// Follows a text while `nlohmann::json::sax_parse` reads it; overrides look at what they need. It
/// takes time in proportion to the text, unlike a callback of `parse`: with one, the parser looks
/// through all elements of an array whenever an object in it ends.
class JsonVisitor : public nlohmann::json_sax<nlohmann::json> {
  public:
    bool null() override { return value(); }

    bool boolean(bool) override { return value(); }

    bool number_integer(number_integer_t) override { return value(); }

    bool number_unsigned(number_unsigned_t) override { return value(); }

    bool number_float(number_float_t, const string_t&) override { return value(); }

    bool string(string_t&) override { return value(); }

    bool binary(binary_t&) override { return value(); }

    bool start_object(size_t) override { return true; }

    bool key(string_t&) override { return true; }

    bool end_object() override { return true; }

    bool start_array(size_t) override { return true; }

    bool end_array() override { return true; }

    /// Ends at the first error, which `parse` throws.
    bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) override {
        return false;
    }

  protected:
    /// Any value but an array or an object.
    virtual bool value() { return true; }
};

}  // namespace tetralight
