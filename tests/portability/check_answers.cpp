// SPDX-License-Identifier: Apache-2.0
#include "tests/portability/check_answers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace tetralight::portability {
namespace {

// What docs/how_to_query.md allows readers to differ by.
constexpr double kLightTolerance = 1e-5;
constexpr double kOcclusionTolerance = 2e-5;

constexpr size_t kCoefficients = 27;

/// Reads the words one after the other. Reads zeros after the last one.
class WordReader {
  public:
    explicit WordReader(std::span<const uint32_t> words) : words_(words) {}

    uint32_t next() {
        if (words_.empty()) {
            is_short_ = true;
            return 0;
        }
        const uint32_t word = words_[0];
        words_ = words_.subspan(1);
        return word;
    }

    float next_float() { return std::bit_cast<float>(next()); }

    std::vector<float> floats(size_t count) {
        std::vector<float> values(std::min(count, words_.size()));
        is_short_ = is_short_ || values.size() < count;
        for (float& value : values) value = next_float();
        return values;
    }

    [[nodiscard]] bool has_ended() const { return words_.empty() && !is_short_; }

    [[nodiscard]] bool is_short() const { return is_short_; }

  private:
    std::span<const uint32_t> words_;
    bool is_short_ = false;
};

struct Case {
    float largest_light = 0.0f;
    uint32_t outside = 0;
    float fade_distance = 0.0f;
    uint32_t walls = 0;
    uint32_t rendering_layers = 0;
    float radius = 0.0f;
    float normal_offset = 0.0f;
    std::vector<float> layer_weights;
    std::vector<float> positions, normals, light, occlusion;
    size_t count = 0;
};

void append(std::vector<float>& values, const std::vector<float>& more) {
    values.insert(values.end(), more.begin(), more.end());
}

Case read_case(WordReader& words) {
    Case made;
    made.largest_light = words.next_float();
    made.outside = words.next();
    made.fade_distance = words.next_float();
    made.walls = words.next();
    made.rendering_layers = words.next();
    made.radius = words.next_float();
    made.normal_offset = words.next_float();
    made.layer_weights = words.floats(words.next());
    const uint32_t count = words.next();
    for (uint32_t i = 0; i < count && !words.is_short(); ++i, ++made.count) {
        append(made.positions, words.floats(3));
        append(made.normals, words.floats(3));
        append(made.light, words.floats(kCoefficients));
        append(made.occlusion, words.floats(4));
    }
    return made;
}

template <class T>
tetralight_const_array array_of(const std::vector<T>& values) {
    return {values.data(), values.size() * sizeof(T), 0};
}

tetralight_array array_of(std::vector<float>& values) {
    return {values.data(), values.size() * sizeof(float), 0};
}

/// The largest difference of two arrays over the tolerance. Infinite where one is not a number.
double difference(const std::vector<float>& ours, const std::vector<float>& expected,
                  double tolerance) {
    double largest = 0.0;
    for (size_t i = 0; i < ours.size(); ++i) {
        const double apart = std::abs(double(ours[i]) - double(expected[i])) / tolerance;
        largest = apart <= largest ? largest : std::isnan(apart) ? HUGE_VAL : apart;
    }
    return largest;
}

/// Answers a case in one call. Returns the largest difference over the tolerance.
double check_case(tetralight_volume* volume, const Case& made, tetralight_error& error) {
    const auto& weights = made.layer_weights;
    if (!weights.empty()) {
        tetralight_recombine(volume, weights.data(), weights.size(), &error);
        if (error.message[0] != '\0') return HUGE_VAL;
    }
    std::vector<float> light(made.light.size()), occlusion(made.occlusion.size());
    const std::vector<uint32_t> layers(made.count, made.rendering_layers);
    const std::vector<float> radii(made.count, made.radius);
    tetralight_batch batch = {};
    batch.count = made.count;
    batch.positions = array_of(made.positions);
    batch.sh = array_of(light);
    batch.sh_format = TETRALIGHT_SH_COEFFICIENTS;
    batch.occlusion = array_of(occlusion);
    batch.outside = made.outside;
    batch.fade_distance = made.fade_distance;
    batch.walls = made.walls;
    batch.rendering_layers = array_of(layers);
    batch.radii = array_of(radii);
    if (made.normal_offset >= 0.0f) {
        batch.normals = array_of(made.normals);
        batch.normal_offset = made.normal_offset;
    }
    if (tetralight_query_batch(volume, &batch, nullptr, &error) != TETRALIGHT_OK) return HUGE_VAL;
    return std::max(difference(light, made.light, kLightTolerance * double(made.largest_light)),
                    difference(occlusion, made.occlusion, kOcclusionTolerance));
}

}  // namespace

CheckResult check_answers(const OpenVolume& open, std::span<const uint32_t> words) {
    CheckResult result;
    WordReader reader(words);
    const uint32_t count = reader.next();
    for (; result.case_count < count && !reader.is_short(); ++result.case_count) {
        const Case made = read_case(reader);
        tetralight_error error = {};
        tetralight_volume* volume = open(&error);
        if (volume != nullptr) {
            result.worst = std::max(result.worst, check_case(volume, made, error));
            result.answer_count += static_cast<uint32_t>(made.count);
        }
        tetralight_close(volume);
        if (error.message[0] != '\0') result.failure = error.message;
    }
    if (!reader.has_ended()) result.failure = "the file of cases is damaged";
    return result;
}

}  // namespace tetralight::portability
