// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// A step through a YAML document.
struct YamlEvent {
    enum class Kind { Scalar, SequenceStart, SequenceEnd, MappingStart, MappingEnd, DocumentEnd };

    Kind kind = Kind::DocumentEnd;
    /// That of a scalar.
    std::string text{};
};

/// Reads one YAML document, event by event (libyaml behind it). Errors do not name the line: it is
/// `line()`.
class YamlReader {
  public:
    /// Precondition: the text outlives this object. `first_line` is that of the text in its file.
    YamlReader(std::string_view text, size_t first_line);
    ~YamlReader();
    YamlReader(const YamlReader&) = delete;
    YamlReader& operator=(const YamlReader&) = delete;

    /// The next event. Returns corrupt for a syntax error and more than 64 levels of nesting, and
    /// unsupported for an alias.
    [[nodiscard]] Result<YamlEvent> next();

    /// The line of the last event, or of the error.
    [[nodiscard]] size_t line() const { return line_; }

    /// Reads a scalar. Returns corrupt if the value is anything else.
    [[nodiscard]] Result<std::string> scalar();

    /// Reads a mapping. `visit` takes each key, and must read exactly one value.
    [[nodiscard]] Status mapping(const std::function<Status(const std::string& key)>& visit);

    /// Reads a sequence. `visit` takes each index, and must read exactly one value.
    [[nodiscard]] Status sequence(const std::function<Status(size_t index)>& visit);

    /// Reads a value of any type.
    [[nodiscard]] Status skip();

  private:
    struct Parser;

    [[nodiscard]] Result<YamlEvent> parse();

    std::unique_ptr<Parser> parser_;
    /// An event that was read and not used.
    std::optional<YamlEvent> returned_;
    size_t depth_ = 0;
    size_t first_line_;
    size_t line_;
};

}  // namespace tetralight::detail
