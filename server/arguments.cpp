// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/arguments.h>

#include <algorithm>
#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

std::string option_of(const char* member) {
    std::string option = std::string("--") + member;
    std::ranges::replace(option, '_', '-');
    return option;
}

std::string number_text(const std::string& member, const Json& value) {
    if (value.is_number_unsigned()) return str_cat(value.get<uint64_t>());
    if (value.is_number_integer()) return str_cat(value.get<int64_t>());
    if (!value.is_number()) refuse(member, value, "a number");
    return str_cat(value.get<double>());
}

std::string plain_text(const std::string& member, const Json& value) {
    if (!value.is_string()) refuse(member, value, "a string");
    const auto words = value.get<std::string>();
    if (has_control_character(words) || words.empty()) refuse(member, value, "plain text");
    return words;
}

std::string joined(const std::string& member, const Json& value, size_t count) {
    if (!value.is_array() || value.empty() || (count > 0 && value.size() != count)) {
        refuse(member, value,
               count > 0 ? str_cat("an array of ", count, " numbers") : "an array of numbers");
    }
    std::string list;
    for (const Json& element : value) {
        list += str_cat(list.empty() ? "" : ",", number_text(member, element));
    }
    return list;
}

std::string words(const std::string& member, const Json& value) {
    if (!value.is_array() || value.empty()) refuse(member, value, "an array of strings");
    std::string list;
    for (const Json& element : value) {
        const std::string word = plain_text(member, element);
        if (word.find(',') != std::string::npos) refuse(member, element, "without commas");
        list += str_cat(list.empty() ? "" : ",", word);
    }
    return list;
}

void append(const OptionRule& rule, const Json& value, std::vector<std::string>& arguments) {
    constexpr size_t kVector = 3;
    const std::string member = rule.member;
    const std::string option = option_of(rule.member);
    const auto add = [&](const std::string& text) { arguments.push_back(option + "=" + text); };
    switch (rule.kind) {
        case ValueKind::Number:
            add(number_text(member, value));
            break;
        case ValueKind::Integer:
            if (!value.is_number_integer()) refuse(member, value, "a whole number");
            add(number_text(member, value));
            break;
        case ValueKind::Flag:
            if (!value.is_boolean()) refuse(member, value, "true or false");
            if (value.get<bool>()) arguments.push_back(option);
            break;
        case ValueKind::Text:
            add(plain_text(member, value));
            break;
        case ValueKind::Texts:
            if (!value.is_array()) refuse(member, value, "an array of strings");
            for (const Json& element : value) add(plain_text(member, element));
            break;
        case ValueKind::List:
            add(words(member, value));
            break;
        case ValueKind::Vector:
            add(joined(member, value, kVector));
            break;
        case ValueKind::Numbers:
            add(joined(member, value, 0));
            break;
        case ValueKind::Scale:
            add(value.is_array() ? joined(member, value, kVector) : number_text(member, value));
            break;
    }
}

}  // namespace

std::vector<std::string> make_arguments(Fields& fields, std::span<const OptionRule> rules) {
    std::vector<std::string> arguments;
    for (const OptionRule& rule : rules) {
        const Json* value = fields.find(rule.member);
        if (value != nullptr) append(rule, *value, arguments);
    }
    return arguments;
}

}  // namespace tetralight::server
