// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_raw_elements.h>

#include <algorithm>
#include <cstring>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Elements of accessors without a buffer view are zeros: limited, as for those that are read.
constexpr uint64_t kMaxRawZeros = 1 << 20;

/// Bytes of one component of glTF's types 5120 to 5126; 0 for others.
constexpr size_t raw_component_size(uint32_t type) {
    constexpr size_t kSizes[] = {1, 1, 2, 2, 0, 4, 4};
    return type >= 5120 && type <= 5126 ? kSizes[type - 5120] : 0;
}

/// Numbers are below 2^33, so that no product overflows.
struct RawRun {
    uint32_t view = 0;
    uint64_t byte_offset = 0;
    uint64_t count = 0;
    uint64_t element_size = 0;
};

Result<std::vector<std::byte>> raw_run(const GltfDocument& document, const RawRun& run) {
    const GltfBufferView& view = document.buffer_views[run.view];
    const uint64_t stride = view.byte_stride == 0 ? run.element_size : view.byte_stride;
    const uint64_t end = run.byte_offset + (run.count - 1) * stride + run.element_size;
    if (run.count == 0 || stride < run.element_size || end > view.byte_length) {
        return Error{ErrorCode::Corrupt, str_cat("elements are outside of buffer view ", run.view)};
    }
    const auto buffer = std::as_bytes(std::span(document.buffers[view.buffer]));
    const auto source = buffer.subspan(view.byte_offset + run.byte_offset);
    std::vector<std::byte> packed(run.count * run.element_size);
    for (uint64_t i = 0; i < run.count; ++i) {
        std::memcpy(&packed[i * run.element_size], &source[i * stride], run.element_size);
    }
    return packed;
}

template <class T>
double raw_number(const std::byte* bytes) {
    T value{};
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

double raw_component(const std::byte* bytes, uint32_t type) {
    switch (type) {
        case 5120:
            return raw_number<int8_t>(bytes);
        case 5121:
            return raw_number<uint8_t>(bytes);
        case 5122:
            return raw_number<int16_t>(bytes);
        case 5123:
            return raw_number<uint16_t>(bytes);
        case 5125:
            return raw_number<uint32_t>(bytes);
        default:
            return raw_number<float>(bytes);
    }
}

Status apply_sparse(const GltfDocument& document, const GltfSparse& sparse, RawElements& elements) {
    const size_t index_size = raw_component_size(sparse.index_component_type);
    const bool is_index = index_size > 0 && sparse.index_component_type % 2 == 1;
    if (!is_index || sparse.count > elements.count) {
        return Error{ErrorCode::Corrupt, ".sparse", "", "sparse indices are not sound"};
    }
    const auto indices =
        raw_run(document, {sparse.index_view, sparse.index_byte_offset, sparse.count, index_size});
    if (!indices) return in_member(indices.error().in("sparse indices"), ".sparse.indices");
    const auto values = raw_run(document, {sparse.value_view, sparse.value_byte_offset,
                                           sparse.count, elements.element_size});
    if (!values) return in_member(values.error().in("sparse values"), ".sparse.values");
    for (size_t i = 0; i < sparse.count; ++i) {
        const auto index = static_cast<size_t>(
            raw_component(&(*indices)[i * index_size], sparse.index_component_type));
        if (index >= elements.count) {
            return Error{ErrorCode::Corrupt, ".sparse.indices", str_cat(index),
                         str_cat("sparse index ", index, " is out of range")};
        }
        std::memcpy(&elements.bytes[index * elements.element_size],
                    &(*values)[i * elements.element_size], elements.element_size);
    }
    return Ok{};
}

Result<RawElements> raw_elements(const GltfDocument& document, const GltfAccessor& accessor) {
    RawElements elements;
    elements.count = accessor.count;
    elements.component_type = accessor.component_type;
    elements.component_count = accessor.component_count;
    elements.element_size = raw_component_size(accessor.component_type) * accessor.component_count;
    if (elements.element_size == 0) {
        return Error{ErrorCode::Unsupported, ".type", "",
                     "matrices and unknown types of components cannot be copied"};
    }
    if (accessor.buffer_view != kNoIndex) {
        auto packed = raw_run(document, {accessor.buffer_view, accessor.byte_offset, accessor.count,
                                         elements.element_size});
        if (!packed) return packed.error();
        elements.bytes = std::move(*packed);
    } else if (accessor.count > kMaxRawZeros) {
        return Error{ErrorCode::Unsupported, ".count", str_cat(accessor.count),
                     str_cat(accessor.count, " elements without a buffer view are more than ",
                             kMaxRawZeros)};
    } else {
        elements.bytes.resize(elements.count * elements.element_size);
    }
    if (accessor.sparse) {
        const auto status = apply_sparse(document, *accessor.sparse, elements);
        if (!status) return status.error();
    }
    return elements;
}

}  // namespace

Result<RawElements> read_raw_elements(const GltfDocument& document, uint32_t accessor_index) {
    auto elements = raw_elements(document, document.accessors[accessor_index]);
    if (elements) return elements;
    return in_member(elements.error().in(str_cat("accessor ", accessor_index)),
                     str_cat("accessors[", accessor_index, "]"));
}

RawElements gather_elements(const RawElements& elements, std::span<const uint32_t> indices) {
    RawElements result = elements;
    result.count = indices.size();
    result.bytes.resize(indices.size() * elements.element_size);
    for (size_t i = 0; i < indices.size(); ++i) {
        std::memcpy(&result.bytes[i * elements.element_size],
                    &elements.bytes[indices[i] * elements.element_size], elements.element_size);
    }
    return result;
}

RawBounds raw_bounds(const RawElements& elements) {
    const size_t size = raw_component_size(elements.component_type);
    RawBounds bounds;
    for (size_t component = 0; component < elements.component_count; ++component) {
        const auto at = [&](size_t i) {
            return raw_component(&elements.bytes[i * elements.element_size + component * size],
                                 elements.component_type);
        };
        bounds.min.push_back(at(0));
        bounds.max.push_back(at(0));
        for (size_t i = 1; i < elements.count; ++i) {
            bounds.min.back() = std::min(bounds.min.back(), at(i));
            bounds.max.back() = std::max(bounds.max.back(), at(i));
        }
    }
    return bounds;
}

}  // namespace tetralight::detail
