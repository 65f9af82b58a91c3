// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/yaml_reader.h>

#include <yaml.h>
#include <new>
#include <optional>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/imports/detail/text_file.h>

namespace tetralight::detail {
namespace {

using Kind = YamlEvent::Kind;

/// The scanner of libyaml takes time in proportion to the levels, for each token.
constexpr size_t kMostLevels = 64;

/// An event of libyaml, which owns memory.
class OwnedEvent {
  public:
    OwnedEvent() = default;
    OwnedEvent(const OwnedEvent&) = delete;
    OwnedEvent& operator=(const OwnedEvent&) = delete;

    ~OwnedEvent() { yaml_event_delete(&event); }

    yaml_event_t event{};
};

/// None for events that are not a part of a value.
std::optional<Kind> kind_of(yaml_event_type_t type) {
    switch (type) {
        case YAML_SCALAR_EVENT:
            return Kind::Scalar;
        case YAML_SEQUENCE_START_EVENT:
            return Kind::SequenceStart;
        case YAML_SEQUENCE_END_EVENT:
            return Kind::SequenceEnd;
        case YAML_MAPPING_START_EVENT:
            return Kind::MappingStart;
        case YAML_MAPPING_END_EVENT:
            return Kind::MappingEnd;
        case YAML_DOCUMENT_END_EVENT:
        case YAML_STREAM_END_EVENT:
        case YAML_NO_EVENT:
            return Kind::DocumentEnd;
        default:
            return std::nullopt;
    }
}

Error syntax_error(const yaml_parser_t& parser) {
    if (parser.error == YAML_MEMORY_ERROR) throw std::bad_alloc();
    const std::string_view problem = parser.problem == nullptr ? "" : parser.problem;
    return {ErrorCode::Corrupt,
            str_cat("is not YAML: ", problem.empty() ? std::string_view("syntax error") : problem)};
}

Error not_a(const YamlEvent& event, std::string_view wanted) {
    const std::string value = event.kind == Kind::Scalar          ? quoted_text(event.text)
                              : event.kind == Kind::SequenceStart ? std::string("a list")
                              : event.kind == Kind::MappingStart  ? std::string("a mapping")
                                                                  : std::string("nothing");
    return {ErrorCode::Corrupt, "", event.text.substr(0, 60),
            str_cat("is not ", wanted, " (", value, ")")};
}

}  // namespace

struct YamlReader::Parser {
    yaml_parser_t parser{};
};

YamlReader::YamlReader(std::string_view text, size_t first_line)
    : parser_(std::make_unique<Parser>()), first_line_(first_line), line_(first_line) {
    if (yaml_parser_initialize(&parser_->parser) == 0) throw std::bad_alloc();
    yaml_parser_set_encoding(&parser_->parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser_->parser,
                                 reinterpret_cast<const unsigned char*>(text.data()), text.size());
}

YamlReader::~YamlReader() {
    yaml_parser_delete(&parser_->parser);
}

Result<YamlEvent> YamlReader::next() {
    if (returned_) return *std::exchange(returned_, std::nullopt);
    auto event = parse();
    if (!event) return event;
    if (event->kind == Kind::MappingStart || event->kind == Kind::SequenceStart) ++depth_;
    if (event->kind == Kind::MappingEnd || event->kind == Kind::SequenceEnd) --depth_;
    if (depth_ <= kMostLevels) return event;
    return Error{ErrorCode::Corrupt, str_cat("has more than ", kMostLevels, " levels")};
}

Result<YamlEvent> YamlReader::parse() {
    yaml_parser_t& parser = parser_->parser;
    while (true) {
        OwnedEvent owned;
        yaml_event_t& event = owned.event;
        if (yaml_parser_parse(&parser, &event) == 0) {
            line_ = first_line_ + parser.problem_mark.line;
            return syntax_error(parser);
        }
        line_ = first_line_ + event.start_mark.line;
        if (event.type == YAML_ALIAS_EVENT)
            return Error{ErrorCode::Unsupported, "has an alias of YAML, which is not read"};
        const auto kind = kind_of(event.type);
        if (!kind) continue;
        YamlEvent result{*kind};
        if (*kind == Kind::Scalar) {
            result.text.assign(reinterpret_cast<const char*>(event.data.scalar.value),
                               event.data.scalar.length);
        }
        return result;
    }
}

Result<std::string> YamlReader::scalar() {
    auto event = next();
    if (!event) return event.error();
    if (event->kind != Kind::Scalar) return not_a(*event, "a single value");
    return std::move(event->text);
}

Status YamlReader::mapping(const std::function<Status(const std::string& key)>& visit) {
    const auto start = next();
    if (!start) return start.error();
    if (start->kind != Kind::MappingStart) return not_a(*start, "a mapping");
    while (true) {
        const auto key = next();
        if (!key) return key.error();
        if (key->kind == Kind::MappingEnd) return Ok{};
        if (key->kind != Kind::Scalar) return not_a(*key, "a name");
        if (auto status = visit(key->text); !status) return status;
    }
}

Status YamlReader::sequence(const std::function<Status(size_t index)>& visit) {
    const auto start = next();
    if (!start) return start.error();
    if (start->kind != Kind::SequenceStart) return not_a(*start, "a list");
    for (size_t index = 0;; ++index) {
        auto event = next();
        if (!event) return event.error();
        if (event->kind == Kind::SequenceEnd) return Ok{};
        returned_ = std::move(*event);
        if (auto status = visit(index); !status) return status;
    }
}

Status YamlReader::skip() {
    size_t depth = 0;
    do {
        const auto event = next();
        if (!event) return event.error();
        if (event->kind == Kind::DocumentEnd) return not_a(*event, "a value");
        if (event->kind == Kind::MappingStart || event->kind == Kind::SequenceStart) ++depth;
        if (event->kind == Kind::MappingEnd || event->kind == Kind::SequenceEnd) --depth;
    } while (depth > 0);
    return Ok{};
}

}  // namespace tetralight::detail
