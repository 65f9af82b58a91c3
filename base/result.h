// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include <tetralight/base/contract.h>
#include <tetralight/base/error.h>

namespace tetralight {

/// A value, or the error that prevented it. All functions report bad data this way.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : value_(std::move(value)) {}

    Result(Error error) : error_(std::move(error)) {}

    [[nodiscard]] explicit operator bool() const noexcept { return value_.has_value(); }

    /// Precondition: there is a value.
    [[nodiscard]] T& operator*() & { return checked(); }

    [[nodiscard]] const T& operator*() const& { return const_cast<Result*>(this)->checked(); }

    [[nodiscard]] T&& operator*() && { return std::move(checked()); }

    [[nodiscard]] T* operator->() { return &checked(); }

    [[nodiscard]] const T* operator->() const { return &const_cast<Result*>(this)->checked(); }

    /// The error. Precondition: there is no value.
    [[nodiscard]] const Error& error() const {
        TETRALIGHT_ASSERT(!value_, "error() of a Result that holds a value");
        return error_;
    }

  private:
    [[nodiscard]] T& checked() {
        TETRALIGHT_ASSERT(value_, "value of a Result that holds an error");
        return *value_;
    }

    std::optional<T> value_;
    Error error_;
};

/// The value of a function that returns only success or an error: `return Ok{};`.
struct Ok {
    bool operator==(const Ok&) const = default;
};

using Status = Result<Ok>;

}  // namespace tetralight
