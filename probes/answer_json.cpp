// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/answer_json.h>

#include <charconv>
#include <cmath>
#include <cstring>

namespace tetralight {
namespace {

/// Writes text and numbers one after the other.
class Writer {
  public:
    explicit Writer(char* to) noexcept : to_(to) {}

    [[nodiscard]] char* end() const noexcept { return to_; }

    template <size_t kSize>
    void text(const char (&characters)[kSize]) noexcept {
        std::memcpy(to_, characters, kSize - 1);
        to_ += kSize - 1;
    }

    void index(uint32_t index) noexcept { to_ = std::to_chars(to_, to_ + kRoom, index).ptr; }

    void number(float number) noexcept {
        if (!std::isfinite(number)) return text("null");
        to_ = std::to_chars(to_, to_ + kRoom, number).ptr;
        // Parsers read "-0" as the integer 0, which has no sign.
        if (number == 0.0f && std::signbit(number)) text(".0");
    }

    /// `[1,2,3]`
    template <class Vector>
    void vector(const Vector& vector) noexcept {
        for (int i = 0; i < Vector::length(); ++i) {
            *to_++ = i == 0 ? '[' : ',';
            number(vector[i]);
        }
        *to_++ = ']';
    }

    /// The probes of a cell with their weights.
    void probes(const Cell& cell, const glm::vec4& weights) noexcept {
        for (int i = 0; i < 4; ++i) {
            const uint32_t probe = cell.vertices[static_cast<size_t>(i)];
            if (probe == kNoIndex) continue;
            if (to_[-1] != '[') *to_++ = ',';
            text(R"({"probe":)");
            index(probe);
            text(R"(,"weight":)");
            number(weights[i]);
            *to_++ = '}';
        }
    }

  private:
    static constexpr size_t kRoom = 16;  // -1.17549435e-38 is the longest

    char* to_;
};

}  // namespace

char* write_json(char* to, const ProbeVolumeView& volume, const AnsweredPosition& answer) noexcept {
    const uint32_t cell = answer.location.cell;
    return write_json(to, cell < volume.cells.size() ? &volume.cells[cell] : nullptr, answer);
}

char* write_json(char* to, const Cell* cell, const AnsweredPosition& answer) noexcept {
    Writer writer(to);
    writer.text(R"({"position":)");
    writer.vector(answer.position);
    writer.text(R"(,"cell":)");
    const CellLocation& location = answer.location;
    if (cell != nullptr) {
        writer.index(location.cell);
        writer.text(R"(,"probes":[)");
        writer.probes(*cell, location.weights);
    } else {
        writer.text(R"(null,"probes":[)");
    }
    writer.text(R"(],"ambient":)");
    writer.number(location.ambient);
    writer.text(R"(,"irradiance_sh":)");
    for (size_t i = 0; i < answer.irradiance.coefficients.size(); ++i) {
        writer.text(i == 0 ? "[" : ",");
        writer.vector(answer.irradiance.coefficients[i]);
    }
    writer.text(R"(],"occlusion":)");
    writer.vector(answer.occlusion);
    writer.text("}");
    return writer.end();
}

}  // namespace tetralight
