// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/unity_file.h>

#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <system_error>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/text_file.h>
#include <tetralight/imports/detail/unity_documents.h>
#include <tetralight/imports/detail/yaml_reader.h>

namespace tetralight::detail {
namespace {

// Of Unity's list of classes.
constexpr int64_t kGameObject = 1;
constexpr int64_t kTransform = 4;
constexpr int64_t kLightProbeGroup = 220;
constexpr int64_t kRectTransform = 224;
constexpr int64_t kPrefabInstance = 1001;

/// Puts the name of a member before the message of its value: `m_Father: is not a mapping`.
template <class T>
Result<T> named(Result<T> value, std::string_view name) {
    if (value) return value;
    Error error = value.error().in(name);
    if (error.field.empty()) error.field = name;
    return error;
}

Result<double> read_number(YamlReader& yaml, std::string_view name) {
    const auto text = yaml.scalar();
    if (!text) return named(Result<double>(text.error()), name);
    return parse_number(*text, name);
}

/// Reads `{x: 1, y: 2, z: 3}` into `numbers`, in the order of `names`. All must be there.
Status read_numbers(YamlReader& yaml, std::string_view names, double* numbers) {
    uint32_t seen = 0;
    const auto status = yaml.mapping([&](const std::string& key) -> Status {
        const size_t i = key.size() == 1 ? names.find(key) : std::string_view::npos;
        if (i == std::string_view::npos) return yaml.skip();
        const auto number = read_number(yaml, key);
        if (!number) return number.error();
        numbers[i] = *number;
        seen |= 1u << i;
        return Ok{};
    });
    if (!status) return status;
    for (size_t i = 0; i < names.size(); ++i) {
        if ((seen >> i & 1u) == 0)
            return Error{ErrorCode::Corrupt, std::string(1, names[i]), "",
                         str_cat(names[i], " is missing")};
    }
    return Ok{};
}

Status read_vec3(YamlReader& yaml, glm::dvec3& vector) {
    double numbers[3] = {};
    if (auto status = read_numbers(yaml, "xyz", numbers); !status) return status;
    vector = {numbers[0], numbers[1], numbers[2]};
    return Ok{};
}

Status read_rotation(YamlReader& yaml, glm::dvec4& rotation) {
    double numbers[4] = {};
    if (auto status = read_numbers(yaml, "xyzw", numbers); !status) return status;
    const glm::dvec4 quaternion(numbers[0], numbers[1], numbers[2], numbers[3]);
    const double length = glm::length(quaternion);
    if (!(length > 0.0) || !std::isfinite(length)) {
        return Error{ErrorCode::Corrupt, "", str_cat(length),
                     str_cat("the length of the quaternion is ", length)};
    }
    rotation = quaternion / length;
    return Ok{};
}

/// Reads `{fileID: 123}`.
Status read_id(YamlReader& yaml, UnityId& id) {
    bool is_seen = false;
    const auto status = yaml.mapping([&](const std::string& key) -> Status {
        if (key != "fileID") return yaml.skip();
        const auto text = yaml.scalar();
        if (!text) return text.error();
        const char* const last = text->data() + text->size();
        const auto [end, error] = std::from_chars(text->data(), last, id);
        is_seen = true;
        if (error == std::errc() && end == last) return Ok{};
        return Error{ErrorCode::Corrupt, "fileID", text->substr(0, 60),
                     str_cat("fileID is not an integer of 64 bits (", quoted_text(*text), ")")};
    });
    if (!status || is_seen) return status;
    return Error{ErrorCode::Corrupt, "fileID", "", "fileID is missing"};
}

Status read_flag(YamlReader& yaml, bool& flag) {
    const auto text = yaml.scalar();
    if (!text) return text.error();
    if (*text != "0" && *text != "1") {
        return Error{ErrorCode::Corrupt, "", text->substr(0, 60),
                     str_cat("is not 0 or 1 (", quoted_text(*text), ")")};
    }
    flag = *text == "1";
    return Ok{};
}

/// Reads `CLASS:` and the members of the object. `visit` reads the value of a member, or returns
/// none for a member that it does not know.
template <class Visit>
Status read_members(YamlReader& yaml, const Visit& visit) {
    return yaml.mapping([&](const std::string& class_name) -> Status {
        auto status = yaml.mapping([&](const std::string& key) -> Status {
            const std::optional<Status> read = visit(key);
            return read ? named(*read, key) : yaml.skip();
        });
        return status ? status : Status(status.error().in(class_name));
    });
}

Status read_object(YamlReader& yaml, UnityObject& object) {
    return read_members(yaml, [&](const std::string& key) -> std::optional<Status> {
        if (key == "m_IsActive") return read_flag(yaml, object.is_active);
        if (key != "m_Name") return std::nullopt;
        auto name = yaml.scalar();
        if (!name) return Status(name.error());
        object.name = std::move(*name);
        return Status(Ok{});
    });
}

Status read_transform(YamlReader& yaml, UnityTransform& transform) {
    return read_members(yaml, [&](const std::string& key) -> std::optional<Status> {
        if (key == "m_GameObject") return read_id(yaml, transform.object);
        if (key == "m_Father") return read_id(yaml, transform.parent);
        if (key == "m_LocalPosition") return read_vec3(yaml, transform.position);
        if (key == "m_LocalRotation") return read_rotation(yaml, transform.rotation);
        if (key == "m_LocalScale") return read_vec3(yaml, transform.scale);
        return std::nullopt;
    });
}

Status read_probes(YamlReader& yaml, UnityProbes& probes) {
    return read_members(yaml, [&](const std::string& key) -> std::optional<Status> {
        if (key == "m_GameObject") return read_id(yaml, probes.object);
        if (key == "m_Enabled") return read_flag(yaml, probes.is_enabled);
        if (key == "m_Dering") return read_flag(yaml, probes.dering);
        if (key != "m_SourcePositions") return std::nullopt;
        probes.positions.clear();
        return yaml.sequence([&](size_t index) -> Status {
            auto status = read_vec3(yaml, probes.positions.emplace_back());
            return status ? status : Status(status.error().in(str_cat("probe ", index)));
        });
    });
}

class UnityParser {
  public:
    Status add(const UnityDocument& document) {
        YamlReader yaml(document.body, document.line + 1);
        const Status status = add(document, yaml);
        if (status) return status;
        return status.error().in(str_cat(yaml.line(), ": object ", document.id));
    }

    UnityFile file;

  private:
    Status add(const UnityDocument& document, YamlReader& yaml) {
        switch (document.class_id) {
            case kGameObject:
                return add_object(document, yaml);
            case kTransform:
            case kRectTransform:
                return add_transform(document, yaml);
            case kLightProbeGroup:
                return add_probes(document, yaml);
            case kPrefabInstance:
                ++file.prefab_instance_count;
                return Ok{};
            default:
                return Ok{};
        }
    }

    static Error duplicate() {
        return {ErrorCode::Corrupt, "fileID", "", "another object has the same ID"};
    }

    Status add_object(const UnityDocument& document, YamlReader& yaml) {
        const auto [place, is_new] = file.objects.try_emplace(document.id);
        if (!is_new) return duplicate();
        place->second.is_stripped = document.is_stripped;
        return document.is_stripped ? Ok{} : read_object(yaml, place->second);
    }

    Status add_transform(const UnityDocument& document, YamlReader& yaml) {
        const auto [place, is_new] = file.transforms.try_emplace(document.id);
        if (!is_new) return duplicate();
        UnityTransform& transform = place->second;
        transform.is_stripped = document.is_stripped;
        transform.line = document.line;
        // A stripped transform may name its object, so that components find it.
        if (auto status = read_transform(yaml, transform); !status) return status;
        if (transform.object == 0) return Ok{};
        if (file.transform_of_object.emplace(transform.object, document.id).second) return Ok{};
        return Error{ErrorCode::Corrupt, "m_GameObject", str_cat(transform.object),
                     str_cat("object ", transform.object, " has two transforms")};
    }

    Status add_probes(const UnityDocument& document, YamlReader& yaml) {
        if (document.is_stripped) return Ok{};
        UnityProbes& probes = file.probes.emplace_back();
        probes.id = document.id;
        probes.line = document.line;
        return read_probes(yaml, probes);
    }
};

}  // namespace

Result<UnityFile> parse_unity_file(std::string_view text) {
    UnityDocuments documents(text);
    UnityParser parser;
    while (true) {
        const auto document = documents.next();
        if (!document) return document.error();
        if (!*document) return std::move(parser.file);
        if (auto status = parser.add(**document); !status) return status.error();
    }
}

}  // namespace tetralight::detail
