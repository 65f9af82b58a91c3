// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string_view>
#include <type_traits>

#include <tetralight/settings/values.h>

// From checked settings to the library's types.

namespace tetralight::cli {

using settings::Values;

/// Wrong usage, found after the settings were read one by one: exit code 2. Commands throw it.
struct UsageError {
    Error error;
};

/// Throws a `UsageError` about one setting: "--fade: needs --outside ambient".
[[noreturn]] void refuse(const Values& values, std::string_view name, std::string_view message);

/// The same with the reason that a library gives.
[[noreturn]] void refuse_because(const Values& values, std::string_view name, const Error& reason);

/// Throws a `UsageError`: "--output is required".
[[noreturn]] void require(const Values& values, std::string_view name);

/// The choices of the setting stand in the order of the enumerators.
template <class Enum>
[[nodiscard]] Enum choice(const Values& values, std::string_view name) {
    return static_cast<Enum>(values.choice(name));
}

/// True if the command has a setting of this name.
[[nodiscard]] inline bool has_setting(const Values& values, std::string_view name) {
    return values.table().find(name) != nullptr;
}

/// Sets `member` to the setting's value, if it was given or has a default.
template <class T>
void read_if_any(const Values& values, std::string_view name, T& member) {
    const settings::Json* value = values.find(name);
    if (value == nullptr) return;
    if constexpr (std::is_enum_v<T>) {
        member = choice<T>(values, name);
    } else {
        member = value->get<T>();
    }
}

[[nodiscard]] inline glm::dvec3 vec3(const Values& values, std::string_view name) {
    const auto v = values.vector(name);
    return {v[0], v[1], v[2]};
}

}  // namespace tetralight::cli
