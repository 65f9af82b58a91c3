// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_accessors.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <type_traits>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kByte = 5120;
constexpr uint32_t kUnsignedByte = 5121;
constexpr uint32_t kShort = 5122;
constexpr uint32_t kUnsignedShort = 5123;
constexpr uint32_t kUnsignedInt = 5125;
constexpr uint32_t kFloat = 5126;

/// Bytes of one component; 0 if the type is unknown or not read.
uint64_t component_size(uint32_t component_type) {
    switch (component_type) {
        case kByte:
        case kUnsignedByte:
            return 1;
        case kShort:
        case kUnsignedShort:
            return 2;
        case kUnsignedInt:
        case kFloat:
            return 4;
        default:
            return 0;
    }
}

/// A run of elements in a buffer view.
struct ElementRun {
    uint64_t byte_offset = 0;
    uint64_t count = 0;
    uint64_t element_size = 0;
};

/// Where the elements of a run begin, and the bytes from one to the next. No product overflows,
/// since all numbers are below 2^33.
struct PlacedElements {
    const std::byte* first = nullptr;
    uint64_t stride = 0;
};

Result<PlacedElements> find_run(const GltfDocument& document, uint32_t view_index,
                                const ElementRun& run) {
    const GltfBufferView& view = document.buffer_views[view_index];
    const uint64_t stride = view.byte_stride == 0 ? run.element_size : view.byte_stride;
    if (stride < run.element_size) {
        return Error{ErrorCode::Corrupt, str_cat("bufferViews[", view_index, "].byteStride"),
                     str_cat(stride),
                     str_cat("byteStride ", stride, " of buffer view ", view_index,
                             " is less than an element's ", run.element_size, " bytes")};
    }
    const uint64_t end = run.byte_offset + (run.count - 1) * stride + run.element_size;
    if (end > view.byte_length) {
        return Error{ErrorCode::Corrupt,
                     str_cat("bytes ", run.byte_offset, " to ", end, " are outside of buffer view ",
                             view_index, " (", view.byte_length, " bytes)")};
    }
    const auto buffer = std::as_bytes(std::span(document.buffers[view.buffer]));
    return PlacedElements{buffer.data() + view.byte_offset + run.byte_offset, stride};
}

/// One unsigned integer of 1, 2 or 4 bytes.
uint32_t unsigned_at(const std::byte* bytes, uint32_t component_type) {
    if (component_type == kUnsignedByte) return std::to_integer<uint32_t>(*bytes);
    if (component_type == kUnsignedShort) {
        uint16_t value = 0;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    uint32_t value = 0;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

bool is_index_type(uint32_t component_type) {
    return component_type == kUnsignedByte || component_type == kUnsignedShort ||
           component_type == kUnsignedInt;
}

Status replace_sparse(const GltfDocument& document, const GltfAccessor& accessor,
                      std::span<std::byte> packed) {
    const GltfSparse& sparse = *accessor.sparse;
    if (sparse.count == 0 || sparse.count > accessor.count) {
        return Error{ErrorCode::Corrupt, ".sparse.count", str_cat(sparse.count),
                     str_cat("sparse count ", sparse.count, " is not in 1 to ", accessor.count)};
    }
    if (!is_index_type(sparse.index_component_type)) {
        return Error{ErrorCode::Corrupt, ".sparse.indices.componentType",
                     str_cat(sparse.index_component_type),
                     str_cat("sparse indices: component type ", sparse.index_component_type,
                             " is not supported")};
    }
    const uint64_t element_size = packed.size() / accessor.count;
    const uint64_t index_size = component_size(sparse.index_component_type);
    const auto indices =
        find_run(document, sparse.index_view, {sparse.index_byte_offset, sparse.count, index_size});
    if (!indices) return in_member(indices.error().in("sparse indices"), ".sparse.indices");
    const auto values = find_run(document, sparse.value_view,
                                 {sparse.value_byte_offset, sparse.count, element_size});
    if (!values) return in_member(values.error().in("sparse values"), ".sparse.values");
    for (uint64_t i = 0; i < sparse.count; ++i) {
        const uint32_t index =
            unsigned_at(indices->first + i * indices->stride, sparse.index_component_type);
        if (index >= accessor.count) {
            return Error{ErrorCode::Corrupt, str_cat(".sparse.indices[", i, "]"), str_cat(index),
                         str_cat("sparse index ", index, " is out of range (", accessor.count,
                                 " elements)")};
        }
        std::memcpy(&packed[index * element_size], values->first + i * values->stride,
                    element_size);
    }
    return Ok{};
}

/// The elements of an accessor: where they are in the buffer, or packed in `copy` with the sparse
/// ones replaced.
struct AccessorElements {
    PlacedElements placed;
    std::vector<std::byte> copy;
};

Result<AccessorElements> find_elements(const GltfDocument& document, const GltfAccessor& accessor) {
    const uint64_t element_size =
        component_size(accessor.component_type) * accessor.component_count;
    if (accessor.count == 0) return Error{ErrorCode::Corrupt, ".count", "0", "has no elements"};
    const bool is_zero = accessor.buffer_view == kNoIndex;
    if (is_zero && accessor.count > kMaxZeroElements) {
        return Error{ErrorCode::Unsupported, ".count", str_cat(accessor.count),
                     str_cat(accessor.count, " elements without a buffer view are more than ",
                             kMaxZeroElements)};
    }
    AccessorElements elements;
    if (!is_zero) {
        const auto run = find_run(document, accessor.buffer_view,
                                  {accessor.byte_offset, accessor.count, element_size});
        if (!run) return run.error();
        elements.placed = *run;
        if (!accessor.sparse) return elements;
    }
    elements.copy.resize(accessor.count * element_size);
    for (uint64_t i = 0; !is_zero && i < accessor.count; ++i) {
        std::memcpy(&elements.copy[i * element_size],
                    elements.placed.first + i * elements.placed.stride, element_size);
    }
    elements.placed = {elements.copy.data(), element_size};
    if (accessor.sparse) {
        const auto status = replace_sparse(document, accessor, elements.copy);
        if (!status) return status.error();
    }
    return elements;
}

/// Writes the elements' components one after the other: integers as they are or, if they are
/// normalized, divided by the largest one.
template <class Component>
void copy_components(const PlacedElements& elements, const GltfAccessor& accessor,
                     float* components) {
    for (uint64_t i = 0; i < accessor.count; ++i) {
        const std::byte* bytes = elements.first + i * elements.stride;
        for (uint32_t axis = 0; axis < accessor.component_count; ++axis) {
            Component value{};
            std::memcpy(&value, bytes + axis * sizeof value, sizeof value);
            *components = static_cast<float>(value);
            if (std::is_integral_v<Component> && accessor.is_normalized) {
                constexpr auto kLargest = static_cast<float>(std::numeric_limits<Component>::max());
                *components = std::max(*components / kLargest, -1.0f);
            }
            ++components;
        }
    }
}

void copy_floats(const PlacedElements& elements, const GltfAccessor& accessor, float* components) {
    switch (accessor.component_type) {
        case kByte:
            return copy_components<int8_t>(elements, accessor, components);
        case kUnsignedByte:
            return copy_components<uint8_t>(elements, accessor, components);
        case kShort:
            return copy_components<int16_t>(elements, accessor, components);
        case kUnsignedShort:
            return copy_components<uint16_t>(elements, accessor, components);
        default:
            return copy_components<float>(elements, accessor, components);
    }
}

Error component_type_error(const GltfAccessor& accessor, const char* reason) {
    return {ErrorCode::Corrupt, ".componentType", str_cat(accessor.component_type),
            str_cat("component type ", accessor.component_type, reason)};
}

std::string type_name(int component_count) {
    if (component_count == 1) return "SCALAR";
    return component_count == 16 ? "MAT4" : str_cat("VEC", component_count);
}

Status check_float_type(const GltfAccessor& accessor, int component_count) {
    if (accessor.component_count != static_cast<uint32_t>(component_count)) {
        return Error{ErrorCode::Corrupt, ".type", "",
                     str_cat("is not of type ", type_name(component_count))};
    }
    const bool is_known = component_size(accessor.component_type) != 0;
    if (is_known && accessor.component_type != kUnsignedInt) return Ok{};
    return component_type_error(accessor, " is not supported here");
}

Status check_finite(std::span<const float> components, uint32_t component_count) {
    for (size_t i = 0; i < components.size(); ++i) {
        if (std::isfinite(components[i])) continue;
        const size_t element = i / component_count, axis = i % component_count;
        return Error{ErrorCode::Corrupt, str_cat("[", element, "][", axis, "]"),
                     str_cat(components[i]),
                     str_cat("element ", element, " is not finite (component ", axis, " is ",
                             components[i], ")")};
    }
    return Ok{};
}

/// `Element`: a float, or a vector or matrix of floats.
template <class Element>
Result<std::vector<Element>> decode_floats(const GltfDocument& document,
                                           const GltfAccessor& accessor) {
    constexpr int kCount = sizeof(Element) / sizeof(float);
    const auto type = check_float_type(accessor, kCount);
    if (!type) return type.error();
    const auto elements = find_elements(document, accessor);
    if (!elements) return elements.error();
    std::vector<Element> values(accessor.count);
    auto* components = reinterpret_cast<float*>(values.data());
    copy_floats(elements->placed, accessor, components);
    const auto status =
        check_finite(std::span(components, values.size() * kCount), accessor.component_count);
    if (!status) return status.error();
    return values;
}

Error in_accessor(const Error& error, uint32_t accessor_index) {
    return in_member(error.in(str_cat("accessor ", accessor_index)),
                     str_cat("accessors[", accessor_index, "]"));
}

template <class Element>
Result<std::vector<Element>> read_floats(const GltfDocument& document, uint32_t accessor_index) {
    auto values = decode_floats<Element>(document, document.accessors[accessor_index]);
    if (!values) return in_accessor(values.error(), accessor_index);
    return values;
}

Result<std::vector<uint32_t>> decode_indices(const GltfDocument& document,
                                             const GltfAccessor& accessor) {
    if (accessor.component_count != 1) {
        return Error{ErrorCode::Corrupt, ".type", "", "is not of type SCALAR"};
    }
    if (!is_index_type(accessor.component_type)) {
        return component_type_error(accessor, " is not supported for indices");
    }
    const auto elements = find_elements(document, accessor);
    if (!elements) return elements.error();
    std::vector<uint32_t> indices(accessor.count);
    const std::byte* bytes = elements->placed.first;
    for (uint32_t& index : indices) {
        index = unsigned_at(bytes, accessor.component_type);
        bytes += elements->placed.stride;
    }
    return indices;
}

}  // namespace

Result<std::vector<float>> read_scalars(const GltfDocument& document, uint32_t accessor_index) {
    return read_floats<float>(document, accessor_index);
}

Result<std::vector<glm::vec2>> read_vec2s(const GltfDocument& document, uint32_t accessor_index) {
    return read_floats<glm::vec2>(document, accessor_index);
}

Result<std::vector<glm::vec3>> read_vec3s(const GltfDocument& document, uint32_t accessor_index) {
    return read_floats<glm::vec3>(document, accessor_index);
}

Result<std::vector<glm::vec4>> read_vec4s(const GltfDocument& document, uint32_t accessor_index) {
    return read_floats<glm::vec4>(document, accessor_index);
}

Result<std::vector<glm::mat4>> read_mat4s(const GltfDocument& document, uint32_t accessor_index) {
    return read_floats<glm::mat4>(document, accessor_index);
}

Result<std::vector<glm::vec4>> read_colors(const GltfDocument& document, uint32_t accessor_index) {
    std::vector<glm::vec4> colors;
    if (document.accessors[accessor_index].component_count == 3) {
        const auto opaque = read_vec3s(document, accessor_index);
        if (!opaque) return opaque.error();
        colors.reserve(opaque->size());
        for (const glm::vec3& color : *opaque) colors.emplace_back(color, 1.0f);
    } else {
        auto read = read_vec4s(document, accessor_index);
        if (!read) return read.error();
        colors = std::move(*read);
    }
    for (size_t i = 0; i < colors.size(); ++i) {
        for (int channel = 0; channel < 4; ++channel) {
            if (colors[i][channel] >= 0.0f) continue;
            const float value = colors[i][channel];
            return in_accessor(
                {ErrorCode::Corrupt, str_cat("[", i, "][", channel, "]"), str_cat(value),
                 str_cat("element ", i, " is negative (", value, ")")},
                accessor_index);
        }
    }
    return colors;
}

Result<std::vector<uint32_t>> read_indices(const GltfDocument& document, uint32_t accessor_index) {
    auto indices = decode_indices(document, document.accessors[accessor_index]);
    if (!indices) return in_accessor(indices.error(), accessor_index);
    return indices;
}

}  // namespace tetralight::detail
