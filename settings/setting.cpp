// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/setting.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <tetralight/base/str_cat.h>

namespace tetralight::settings {
namespace {

constexpr const Table* kTables[] = {&kGrid,    &kBake,    &kLightmap, &kUnwrap,         &kReflect,
                                    &kBakeAll, &kPlan,    &kTask,     &kCollect,        &kSubmit,
                                    &kExport,  &kMerge,   &kPrune,    &kTetrahedralize, &kWorld,
                                    &kQuery,   &kRelight, &kLppv,     &kRender,         &kMeshball,
                                    &kExplain, &kInfo,    &kValidate, &kCheckLeaks,     &kVerify,
                                    &kServe,   &kFsck,    &kBackup,   &kRestore};

std::string upper(std::string_view text) {
    std::string word(text);
    for (char& c : word) {
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return word;
}

}  // namespace

const Setting* Table::find(std::string_view name) const {
    const Setting* found = nullptr;
    for_each([&](const Setting& setting) {
        if (setting.name == name) found = &setting;
    });
    return found;
}

std::span<const Table* const> all_tables() {
    return kTables;
}

const Table* find_table(std::string_view command) {
    const auto found =
        std::ranges::find(kTables, command, [](auto* table) { return table->command; });
    return found == std::end(kTables) ? nullptr : *found;
}

std::string shown_name(const Setting& setting, Form form) {
    if (form == Form::Json) return std::string(setting.name);
    if (setting.is_positional) return upper(setting.name);
    std::string option = str_cat("--", setting.name);
    std::ranges::replace(option, '_', '-');
    return option;
}

std::string number_text(double number) {
    if (number == 0x1p64) return "2^64 - 1";
    constexpr double kMostPlain = 1e8;
    if (number == std::floor(number) && std::abs(number) < kMostPlain) {
        return std::to_string(static_cast<int64_t>(number));
    }
    char digits[32];
    std::string text(digits, std::to_chars(digits, std::end(digits), number).ptr);
    // "1e+09" → "1e9", "1e-06" → "1e-6".
    if (const size_t e = text.find('e'); e != std::string::npos) {
        if (text[e + 1] == '+') text.erase(e + 1, 1);
        const size_t digit = text[e + 1] == '-' ? e + 2 : e + 1;
        if (text[digit] == '0') text.erase(digit, 1);
    }
    return text;
}

std::string range_text(const Range& range) {
    const bool has_min = std::isfinite(range.min), has_max = std::isfinite(range.max);
    if (has_min && has_max) {
        return range.excludes_min
                   ? str_cat("above ", number_text(range.min), ", up to ", number_text(range.max))
                   : str_cat(number_text(range.min), " to ", number_text(range.max));
    }
    if (has_min && range.excludes_min) return "above " + number_text(range.min);
    if (has_min) return number_text(range.min) + " or more";
    return has_max ? "up to " + number_text(range.max) : "";
}

std::string value_name(const Setting& setting) {
    if (!setting.value_name.empty()) return std::string(setting.value_name);
    switch (setting.type) {
        case Type::Flag:
            return "";
        case Type::Integer:
            return "N";
        case Type::Number:
            return "X";
        case Type::Fraction:
            return "FRACTION";
        case Type::Seconds:
            return "TIME";
        case Type::Range:
            return "A..B";
        case Type::Text:
            return "TEXT";
        case Type::Choice: {
            std::string words(setting.choices);
            std::ranges::replace(words, ' ', '|');
            return words;
        }
        case Type::Path:
            return "FILE";
        case Type::Vector:
        case Type::Direction:
            return "X,Y,Z";
        case Type::Scale:
            return "X|X,Y,Z";
        case Type::Sky:
            return "L|R,G,B|FILE";
        case Type::Numbers:
        case Type::Integers:
            return "X,...";
        case Type::Words:
            return "TEXT,...";
        case Type::Weights:
            return "NAME=X,...";
    }
    return "";
}

}  // namespace tetralight::settings
