// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

#include <tetralight/probes/delaunay/memory_source.h>

namespace tetralight::detail {

/// An array of plain values that grows, and that says when there is no memory for it: `reserve`
/// returns false then, and nothing has changed. It does not set new values to anything.
template <class T>
class GrowingArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    explicit GrowingArray(const MemorySource& memory) : memory_(memory) {}

    GrowingArray(GrowingArray&& other) noexcept : memory_(other.memory_) { swap(other); }

    GrowingArray& operator=(GrowingArray&& other) noexcept {
        swap(other);
        return *this;
    }

    ~GrowingArray() {
        if (values_ != nullptr) memory_.resize(memory_.context, values_, 0);
    }

    /// Makes room for `capacity` values; more than that as it grows.
    [[nodiscard]] bool reserve(size_t capacity) {
        if (capacity <= capacity_) return true;
        const size_t wanted = std::max(capacity, capacity_ + capacity_ / 2);
        void* moved = memory_.resize(memory_.context, values_, wanted * sizeof(T));
        if (moved == nullptr) return false;
        values_ = static_cast<T*>(moved);
        capacity_ = wanted;
        return true;
    }

    /// Precondition: there is room.
    void push_back(const T& value) { values_[size_++] = value; }

    /// Precondition: there is room.
    void set_size(size_t size) { size_ = size; }

    void clear() { size_ = 0; }

    void pop_back() { --size_; }

    [[nodiscard]] T& operator[](size_t index) { return values_[index]; }

    [[nodiscard]] const T& operator[](size_t index) const { return values_[index]; }

    [[nodiscard]] T& back() { return values_[size_ - 1]; }

    [[nodiscard]] size_t size() const { return size_; }

    [[nodiscard]] bool is_empty() const { return size_ == 0; }

    [[nodiscard]] T* begin() { return values_; }

    [[nodiscard]] T* end() { return values_ + size_; }

    [[nodiscard]] const T* begin() const { return values_; }

    [[nodiscard]] const T* end() const { return values_ + size_; }

    void swap(GrowingArray& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(values_, other.values_);
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
    }

  private:
    MemorySource memory_;
    T* values_ = nullptr;
    size_t size_ = 0;
    size_t capacity_ = 0;
};

}  // namespace tetralight::detail
