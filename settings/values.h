// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/error.h>
#include <tetralight/settings/setting.h>

namespace tetralight::settings {

using Json = nlohmann::ordered_json;

/// The settings of one run of a command: checked values of the types of their table. Values are
/// kept as JSON: Fraction and Seconds as numbers, Vector and Scale as three numbers, Range as
/// [begin, end] or [begin]. A setting that was not given has its default, if it has one.
/// Precondition of all: the table has a setting of this name and of a fitting type.
class Values {
  public:
    Values(const Table& table, Form form);

    /// True if the user gave it; a flag: gave it as true.
    [[nodiscard]] bool is_given(std::string_view name) const;
    /// Null if it was not given and has no default.
    [[nodiscard]] const Json* find(std::string_view name) const;

    [[nodiscard]] bool flag(std::string_view name) const;
    [[nodiscard]] uint64_t integer(std::string_view name) const;    ///< 0 without a value
    [[nodiscard]] uint32_t integer32(std::string_view name) const;  ///< range within 32 bits
    [[nodiscard]] double number(std::string_view name) const;       ///< 0 without a value
    [[nodiscard]] float number32(std::string_view name) const;
    [[nodiscard]] std::string text(std::string_view name) const;  ///< empty without a value
    /// Which of its choices it is, from 0; 0 without a value.
    [[nodiscard]] size_t choice(std::string_view name) const;
    [[nodiscard]] std::array<double, 3> vector(std::string_view name) const;  ///< 0 without
    [[nodiscard]] std::vector<double> numbers(std::string_view name) const;
    /// Bit i is set if i is among its whole numbers; `without` without a value. Precondition: its
    /// range ends at 31 or before.
    [[nodiscard]] uint32_t bits(std::string_view name, uint32_t without) const;
    [[nodiscard]] std::vector<std::string> texts(std::string_view name) const;

    /// Precondition: `value` is of the setting's type and in its range.
    void set(const Setting& setting, Json value);

    [[nodiscard]] const Table& table() const { return *table_; }

    [[nodiscard]] Form form() const { return form_; }

    /// invalid_argument about one setting: `message` follows its name, "--fade: needs ...".
    [[nodiscard]] Error error(std::string_view name, std::string_view message) const;

    /// The name of another setting in a message.
    [[nodiscard]] std::string shown(std::string_view name) const;

  private:
    const Table* table_;
    Form form_;
    Json given_ = Json::object();
    Json defaults_ = Json::object();
};

/// All values, defaults too, in the order of the table.
[[nodiscard]] Json json_from_values(const Values& values);

}  // namespace tetralight::settings
