// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_animation.h>

#include <algorithm>
#include <charconv>
#include <glm/gtc/quaternion.hpp>
#include <set>
#include <vector>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/bake/scene/detail/gltf_transform.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// What a channel animates, with its keys.
struct Keyframes {
    /// Seconds, increasing.
    std::vector<float> times;
    /// The numbers of all values, `width` for each; with cubic splines, each key has three values:
    /// tangent before it, value, tangent behind it.
    std::vector<double> numbers;
    size_t width = 0;
    bool is_cubic = false;

    [[nodiscard]] const double* value(size_t key) const {
        return &numbers[(is_cubic ? 3 * key + 1 : key) * width];
    }

    [[nodiscard]] const double* tangent_before(size_t key) const {
        return &numbers[3 * key * width];
    }

    [[nodiscard]] const double* tangent_behind(size_t key) const {
        return &numbers[(3 * key + 2) * width];
    }
};

Error channel_error(const std::string& message, const std::string& value = "") {
    return {ErrorCode::Corrupt, "", value, message};
}

template <class Element>
std::vector<double> numbers_of(const std::vector<Element>& elements) {
    std::vector<double> numbers;
    for (const Element& element : elements) {
        for (int i = 0; i < Element::length(); ++i) numbers.push_back(element[i]);
    }
    return numbers;
}

/// The number of morph targets of a node's mesh.
size_t target_count(const GltfDocument& document, uint32_t node) {
    const uint32_t mesh = document.nodes[node].mesh;
    size_t count = 0;
    if (mesh == kNoIndex) return count;
    for (const GltfPrimitive& primitive : document.meshes[mesh].primitives) {
        count = std::max(count, primitive.targets.size());
    }
    return count;
}

Result<std::vector<double>> read_numbers(const GltfDocument& document, const GltfChannel& channel) {
    if (channel.path == "weights") {
        const auto scalars = read_scalars(document, channel.output);
        if (!scalars) return scalars.error();
        return std::vector<double>(scalars->begin(), scalars->end());
    }
    if (channel.path == "rotation") {
        const auto rotations = read_vec4s(document, channel.output);
        if (!rotations) return rotations.error();
        return numbers_of(*rotations);
    }
    const auto vectors = read_vec3s(document, channel.output);
    if (!vectors) return vectors.error();
    return numbers_of(*vectors);
}

size_t value_width(const GltfDocument& document, const GltfChannel& channel) {
    if (channel.path == "weights") return target_count(document, channel.node);
    return channel.path == "rotation" ? 4 : 3;
}

Status check_times(const std::vector<float>& times) {
    for (size_t i = 1; i < times.size(); ++i) {
        if (times[i] > times[i - 1]) continue;
        return channel_error(str_cat("time ", i, " (", times[i], ") is not after time ", i - 1,
                                     " (", times[i - 1], ")"),
                             str_cat(times[i]));
    }
    return Ok{};
}

Result<Keyframes> read_keyframes(const GltfDocument& document, const GltfChannel& channel) {
    const std::string& interpolation = channel.interpolation;
    if (interpolation != "LINEAR" && interpolation != "STEP" && interpolation != "CUBICSPLINE") {
        return channel_error(str_cat("interpolation \"", quoted_value(interpolation),
                                     "\" is not \"LINEAR\", \"STEP\" or \"CUBICSPLINE\""),
                             quoted_value(interpolation));
    }
    auto times = read_scalars(document, channel.input);
    if (!times) return times.error().in("times");
    if (auto status = check_times(*times); !status) return status.error();
    auto numbers = read_numbers(document, channel);
    if (!numbers) return numbers.error().in("values");
    Keyframes keys{std::move(*times), std::move(*numbers), value_width(document, channel),
                   interpolation == "CUBICSPLINE"};
    const size_t expected = keys.times.size() * keys.width * (keys.is_cubic ? 3 : 1);
    if (keys.numbers.size() == expected) return keys;
    return channel_error(str_cat(keys.times.size(), " times need ", expected, " numbers of ",
                                 channel.path, ", there are ", keys.numbers.size()),
                         str_cat(keys.numbers.size()));
}

/// A cubic Hermite spline between two keys at t in 0 to 1 (glTF 2.0, appendix C.5).
std::vector<double> spline_value(const Keyframes& keys, size_t key, double t) {
    const double duration = double{keys.times[key + 1]} - double{keys.times[key]};
    const double t2 = t * t, t3 = t2 * t;
    std::vector<double> result(keys.width);
    for (size_t i = 0; i < keys.width; ++i) {
        result[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * keys.value(key)[i] +
                    duration * (t3 - 2.0 * t2 + t) * keys.tangent_behind(key)[i] +
                    (3.0 * t2 - 2.0 * t3) * keys.value(key + 1)[i] +
                    duration * (t3 - t2) * keys.tangent_before(key + 1)[i];
    }
    return result;
}

glm::dquat quaternion_from(const double* xyzw) {
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

/// The shortest way from one rotation to the next.
std::vector<double> slerp_value(const Keyframes& keys, size_t key, double t) {
    const glm::dquat from = glm::normalize(quaternion_from(keys.value(key)));
    const glm::dquat to = glm::normalize(quaternion_from(keys.value(key + 1)));
    const glm::dquat q = glm::slerp(from, to, t);
    return {q.x, q.y, q.z, q.w};
}

std::vector<double> linear_value(const Keyframes& keys, size_t key, double t) {
    std::vector<double> result(keys.width);
    for (size_t i = 0; i < keys.width; ++i) {
        result[i] = (1.0 - t) * keys.value(key)[i] + t * keys.value(key + 1)[i];
    }
    return result;
}

std::vector<double> value_at(const Keyframes& keys, const GltfChannel& channel, double time) {
    const size_t last = keys.times.size() - 1;
    const auto at_key = [&](size_t key) {
        return std::vector<double>(keys.value(key), keys.value(key) + keys.width);
    };
    if (!(time > double{keys.times[0]})) return at_key(0);
    if (time >= double{keys.times[last]}) return at_key(last);
    const auto next = std::upper_bound(keys.times.begin(), keys.times.end(), time);
    const auto key = static_cast<size_t>(next - keys.times.begin()) - 1;
    if (channel.interpolation == "STEP") return at_key(key);
    const double begin = keys.times[key], end = keys.times[key + 1];
    const double t = (time - begin) / (end - begin);
    if (keys.is_cubic) return spline_value(keys, key, t);
    return channel.path == "rotation" ? slerp_value(keys, key, t) : linear_value(keys, key, t);
}

Status set_property(GltfNode& node, const std::string& path, const std::vector<double>& value) {
    if (path == "weights") node.weights = value;
    if (path == "translation") node.translation = {value[0], value[1], value[2]};
    if (path == "scale") node.scale = {value[0], value[1], value[2]};
    if (path != "rotation") return Ok{};
    const glm::dquat rotation = quaternion_from(value.data());
    if (!(glm::length(rotation) > 0.0)) {
        return channel_error("rotation is (0, 0, 0, 0)", "0, 0, 0, 0");
    }
    node.rotation = glm::normalize(rotation);
    return Ok{};
}

bool is_transform(const GltfChannel& channel) {
    return channel.path == "translation" || channel.path == "rotation" || channel.path == "scale";
}

bool is_known(const GltfChannel& channel) {
    return channel.node != kNoIndex && (is_transform(channel) || channel.path == "weights");
}

/// False for a node with a matrix, which its translation, rotation and scale do not give.
bool has_parts(const GltfNode& node) {
    return !is_finite_affine(node.parent_from_node) ||
           node.parent_from_node == compose_transform(node.translation, node.rotation, node.scale);
}

Status check_channel(const GltfDocument& document, const GltfChannel& channel) {
    const GltfNode& node = document.nodes[channel.node];
    const std::string place = gltf_place("node", channel.node, node.name);
    if (is_transform(channel) && !has_parts(node)) {
        return channel_error(str_cat(place, " has a matrix, which cannot be animated"));
    }
    if (is_transform(channel) || target_count(document, channel.node) > 0) return Ok{};
    return channel_error(str_cat("animates weights of ", place, ", which has no morph targets"));
}

Status apply_channel(GltfDocument& document, const GltfChannel& channel, double time) {
    const auto keys = read_keyframes(document, channel);
    if (!keys) return keys.error();
    return set_property(document.nodes[channel.node], channel.path, value_at(*keys, channel, time));
}

Error in_channel(const GltfDocument& document, uint32_t animation, size_t channel,
                 const Error& error) {
    return in_element(
        in_member(error.in(str_cat("channel ", channel)), str_cat(".channels[", channel, "]")),
        "animations", animation, document.animations[animation].name);
}

}  // namespace

Result<uint32_t> find_animation(const GltfDocument& document, const std::string& text) {
    const auto& all = document.animations;
    const auto named = std::ranges::find(all, text, &GltfAnimation::name);
    if (!text.empty() && named != all.end()) return static_cast<uint32_t>(named - all.begin());
    uint32_t index = 0;
    const char* end = text.data() + text.size();
    const bool is_index = text.empty() || std::from_chars(text.data(), end, index).ptr == end;
    if (is_index && index < all.size()) return index;
    if (all.empty()) {
        return Error{ErrorCode::InvalidArgument, "animation", quoted_value(text),
                     "has no animations"};
    }
    std::string list;
    for (size_t i = 0; i < all.size(); ++i) {
        list += str_cat(i == 0 ? "" : ", ", i, " \"", all[i].name, "\"");
    }
    return Error{ErrorCode::InvalidArgument, "animation", quoted_value(text),
                 str_cat("has no animation \"", quoted_value(text), "\"; it has ", list)};
}

Status pose_nodes(GltfDocument& document, uint32_t animation, double time) {
    const std::vector<GltfChannel>& channels = document.animations[animation].channels;
    for (size_t i = 0; i < channels.size(); ++i) {
        if (!is_known(channels[i])) continue;
        const auto status = check_channel(document, channels[i]);
        if (!status) return in_channel(document, animation, i, status.error());
    }
    std::set<uint32_t> moved;
    for (size_t i = 0; i < channels.size(); ++i) {
        if (!is_known(channels[i])) continue;
        const auto status = apply_channel(document, channels[i], time);
        if (!status) return in_channel(document, animation, i, status.error());
        if (is_transform(channels[i])) moved.insert(channels[i].node);
    }
    for (const uint32_t index : moved) {
        GltfNode& node = document.nodes[index];
        node.parent_from_node = compose_transform(node.translation, node.rotation, node.scale);
    }
    return Ok{};
}

Result<GltfDocument> read_posed_document(const std::string& path, const SceneReading& reading) {
    auto document = read_gltf_document(path, reading.scene);
    if (!document || !reading.time) return document;
    const auto animation = find_animation(*document, reading.animation);
    if (!animation) return animation.error().in(path);
    const auto moved = pose_nodes(*document, *animation, *reading.time);
    if (!moved) return moved.error().in(path);
    document->animation = *animation;
    return document;
}

}  // namespace tetralight::detail
