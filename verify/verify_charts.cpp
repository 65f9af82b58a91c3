// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/verify_charts.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/verify/html.h>

namespace tetralight {
namespace {

/// Of all charts, in pixels of the page at its normal size.
constexpr double kWidth = 320.0, kHeight = 240.0;
constexpr double kLeft = 46.0, kRight = 12.0, kTop = 10.0, kBottom = 38.0;

std::string px(double value) {
    return fixed_point(value, 1);
}

std::string line(glm::dvec2 from, glm::dvec2 to, const char* style) {
    return str_cat("<line x1=\"", px(from.x), "\" y1=\"", px(from.y), "\" x2=\"", px(to.x),
                   "\" y2=\"", px(to.y), "\" class=\"", style, "\"/>\n");
}

std::string label(glm::dvec2 at, const char* style, const std::string& text) {
    return element(str_cat("text x=\"", px(at.x), "\" y=\"", px(at.y), "\" class=\"", style, "\""),
                   escape_html(text));
}

std::string svg(const std::string& title, const std::string& content, double height = kHeight) {
    return element(str_cat("svg viewBox=\"0 0 ", px(kWidth), " ", px(height), "\" role=\"img\""),
                   element("title", escape_html(title)) + content);
}

/// Maps an interval of values to an interval of pixels.
struct Axis {
    double low = 0.0, high = 1.0;
    double from = 0.0, to = 1.0;

    [[nodiscard]] double operator()(double value) const {
        return from + (to - from) * (value - low) / (high - low);
    }
};

std::string frame() {
    return str_cat("<rect x=\"", px(kLeft), "\" y=\"", px(kTop), "\" width=\"",
                   px(kWidth - kLeft - kRight), "\" height=\"", px(kHeight - kTop - kBottom),
                   "\" class=\"frame\"/>\n");
}

/// Names of both axes.
std::string axis_names(const std::string& x, const std::string& y) {
    const double middle = (kTop + kHeight - kBottom) / 2.0;
    return label({(kLeft + kWidth - kRight) / 2.0, kHeight - 4.0}, "middle", x) +
           element(str_cat("text transform=\"translate(12 ", px(middle),
                           ") rotate(-90)\" class=\"middle\""),
                   escape_html(y));
}

// Histogram

constexpr double kMostZ = 5.0;
constexpr size_t kBinCount = 40;

std::array<size_t, kBinCount> count_z(const VerifyReport& report, size_t channel) {
    std::array<size_t, kBinCount> counts{};
    for (const VerifyProbe& probe : report.probes) {
        if (!probe.is_decided[channel]) continue;
        const double z = probe.z[static_cast<int>(channel)];
        const double bin = (z + kMostZ) / (2.0 * kMostZ) * kBinCount;
        ++counts[static_cast<size_t>(std::clamp(bin, 0.0, kBinCount - 1.0))];
    }
    return counts;
}

std::string normal_curve(double probes_per_density, const Axis& x, const Axis& y) {
    std::string points;
    for (double z = -kMostZ; z <= kMostZ; z += 0.125) {
        const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
        points += str_cat(px(x(z)), ",", px(y(density * probes_per_density)), " ");
    }
    return str_cat("<polyline points=\"", points, "\" class=\"curve\"/>\n");
}

// Scatter

/// The elements with the largest differences, at most `kMostChartElements`; these last, so that
/// they are drawn above the others.
template <class Element, class Difference>
std::vector<const Element*> drawn_elements(const std::vector<Element>& elements,
                                           const Difference& difference) {
    std::vector<const Element*> drawn;
    for (const Element& one : elements) drawn.push_back(&one);
    std::ranges::stable_sort(drawn, {}, [&](const Element* one) { return difference(*one); });
    if (drawn.size() > kMostChartElements)
        drawn.erase(drawn.begin(), drawn.end() - kMostChartElements);
    return drawn;
}

/// Decades that hold all light of a channel above a thousandth of its largest.
Axis light_axis(const VerifyReport& report, int channel, double from, double to) {
    double low = 1e300, high = 0.0;
    for (const VerifyProbe& probe : report.probes)
        high = std::max({high, probe.volume[channel], probe.traced.mean[channel]});
    for (const VerifyProbe& probe : report.probes) {
        for (const double light : {probe.volume[channel], probe.traced.mean[channel]}) {
            if (light > 1e-3 * high) low = std::min(low, light);
        }
    }
    if (!(high > 0.0)) return {-1.0, 0.0, from, to};
    const double margin = 0.05 * std::max(0.2, std::log10(high / low));
    return {std::log10(low) - margin, std::log10(high) + margin, from, to};
}

/// Marks at 1, 2 and 5 times powers of ten.
std::string light_marks(const Axis& x, const Axis& y) {
    std::string marks;
    const bool is_wide = x.high - x.low > 1.5;
    for (int decade = static_cast<int>(std::floor(x.low)); decade <= x.high; ++decade) {
        for (const double step : {1.0, 2.0, 5.0}) {
            const double value = decade + std::log10(step);
            if (value < x.low || value > x.high || (is_wide && step > 1.0)) continue;
            const std::string text = significant(std::pow(10.0, value), 2);
            marks += line({x(value), kHeight - kBottom}, {x(value), kTop}, "grid");
            marks += line({kLeft, y(value)}, {kWidth - kRight, y(value)}, "grid");
            marks += label({x(value), kHeight - kBottom + 14.0}, "middle", text);
            marks += label({kLeft - 4.0, y(value) + 4.0}, "end", text);
        }
    }
    return marks;
}

struct LightAxes {
    Axis x, y;

    [[nodiscard]] static double at(const Axis& axis, double light) {
        return axis(std::clamp(std::log10(std::max(light, 1e-300)), axis.low, axis.high));
    }
};

std::string scatter_mark(const LightAxes& axes, const VerifyProbe& probe, int channel) {
    const double traced = probe.traced.mean[channel], volume = probe.volume[channel];
    const double wide = 3.0 * probe.traced.error[channel];
    const double high = 3.0 * probe.volume_error[channel];
    const double x = LightAxes::at(axes.x, traced), y = LightAxes::at(axes.y, volume);
    const bool is_far = std::abs(probe.z[channel]) > 3.0;
    const std::string bars = line({LightAxes::at(axes.x, traced - wide), y},
                                  {LightAxes::at(axes.x, traced + wide), y}, "bar") +
                             line({x, LightAxes::at(axes.y, volume - high)},
                                  {x, LightAxes::at(axes.y, volume + high)}, "bar");
    return str_cat(bars, "<circle cx=\"", px(x), "\" cy=\"", px(y), "\" r=\"", is_far ? "4" : "1.8",
                   "\" class=\"", is_far ? "far" : kChannelNames[static_cast<size_t>(channel)],
                   "\"/>\n");
}

// Maps

struct MapMark {
    glm::dvec3 position{0.0};
    /// −1 to 1: from much darker to much brighter than the referee.
    double difference = 0.0;
    bool is_special = false;
    std::string text;
};

struct MapFrame {
    glm::dvec2 low{0.0};
    double scale = 1.0;
    double height = kHeight;

    explicit MapFrame(const std::vector<MapMark>& marks) {
        if (marks.empty()) return;
        glm::dvec2 high(-1e300);
        low = glm::dvec2(1e300);
        for (const MapMark& mark : marks) {
            const glm::dvec2 place(mark.position.x, mark.position.z);
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
        const glm::dvec2 size = glm::max(high - low, glm::dvec2(1e-3));
        // Not higher than 1.5 times its width.
        scale = std::min((kWidth - 40.0) / size.x, 1.5 * kWidth / size.y);
        height = size.y * scale + 64.0;
    }

    [[nodiscard]] glm::dvec2 operator()(const glm::dvec3& position) const {
        return glm::dvec2(20.0) + (glm::dvec2(position.x, position.z) - low) * scale;
    }
};

/// One of seven classes of colour, from `d0` (darker) to `d6` (brighter).
std::string map_class(double difference) {
    return str_cat("d", std::lround(3.0 * std::clamp(difference, -1.0, 1.0)) + 3);
}

/// A rule of about a quarter of the width, in metres, and the directions of the axes.
std::string map_rule(const MapFrame& frame) {
    const double wanted = 0.25 * kWidth / frame.scale;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    const double length = power * (wanted >= 5 * power ? 5 : wanted >= 2 * power ? 2 : 1);
    const double y = frame.height - 22.0;
    return line({20.0, y}, {20.0 + length * frame.scale, y}, "axis") +
           label({20.0, y + 16.0}, "start",
                 significant(length, 2) + " m; +X to the right, +Z down");
}

std::string map_svg(const std::string& title, const std::vector<MapMark>& marks) {
    const MapFrame frame(marks);
    std::string content;
    for (const MapMark& mark : marks) {
        const glm::dvec2 at = frame(mark.position);
        const double size = 2.5 + 2.5 * std::min(std::abs(mark.difference), 1.0);
        content += element(str_cat("circle cx=\"", px(at.x), "\" cy=\"", px(at.y), "\" r=\"",
                                   px(size), "\" class=\"", map_class(mark.difference),
                                   mark.is_special ? " special" : "", "\""),
                           element("title", escape_html(mark.text)));
    }
    return svg(title, content + map_rule(frame), frame.height);
}

std::string position_text(const glm::dvec3& position) {
    return str_cat("(", fixed_point(position.x, 2), ", ", fixed_point(position.y, 2), ", ",
                   fixed_point(position.z, 2), ") m");
}

}  // namespace

double largest_z(const VerifyProbe& probe) noexcept {
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) {
        const bool is_decided = probe.is_decided[static_cast<size_t>(i)];
        if (is_decided && std::abs(probe.z[i]) > std::abs(largest)) largest = probe.z[i];
    }
    return largest;
}

double luminance_difference(const VerifyPlace& place) noexcept {
    return luminance(place.answer) - luminance(place.traced.mean);
}

std::string z_histogram(const VerifyReport& report, size_t channel) {
    const auto counts = count_z(report, channel);
    const auto decided = static_cast<double>(report.channels[channel].decided_count);
    const double per_density = decided * 2.0 * kMostZ / kBinCount;
    const auto most = static_cast<double>(*std::ranges::max_element(counts));
    const double top = std::max({1.0, most, 0.4 * per_density}) * 1.05;
    const Axis x{-kMostZ, kMostZ, kLeft, kWidth - kRight};
    const Axis y{0.0, top, kHeight - kBottom, kTop};
    std::string content;
    for (size_t i = 0; i < kBinCount; ++i) {
        const double z = -kMostZ + 2.0 * kMostZ * static_cast<double>(i) / kBinCount;
        const double width = (kWidth - kLeft - kRight) / kBinCount;
        const double end = y(static_cast<double>(counts[i]));
        content += str_cat("<rect x=\"", px(x(z) + 0.5), "\" y=\"", px(end), "\" width=\"",
                           px(width - 1.0), "\" height=\"", px(y.from - end), "\" class=\"",
                           kChannelNames[channel], "\"/>\n");
    }
    for (int z = -4; z <= 4; z += 2)
        content += label({x(z), kHeight - kBottom + 14.0}, "middle", str_cat(z));
    for (const double z : {-3.0, 3.0}) content += line({x(z), kTop}, {x(z), y.from}, "limit");
    content += label({kLeft - 4.0, y.from + 4.0}, "end", "0");
    content += label({kLeft - 4.0, y(most) + 4.0}, "end", significant(most));
    return svg(
        str_cat("Histogram of z, ", kChannelNames[channel], ": ", significant(decided, 10),
                " decided probes, ", percent_text(report.channels[channel].within_3_sigma),
                " within 3"),
        content + normal_curve(per_density, x, y) + frame() +
            axis_names(str_cat("z, ", kChannelNames[channel], " (standard errors)"), "probes"));
}

std::string light_scatter(const VerifyReport& report, size_t channel) {
    const int c = static_cast<int>(channel);
    const LightAxes axes{light_axis(report, c, kLeft, kWidth - kRight),
                         light_axis(report, c, kHeight - kBottom, kTop)};
    std::string content = light_marks(axes.x, axes.y) +
                          line({kLeft, kHeight - kBottom}, {kWidth - kRight, kTop}, "curve");
    for (const VerifyProbe* probe :
         drawn_elements(report.probes, [&](const VerifyProbe& p) { return std::abs(p.z[c]); })) {
        content += scatter_mark(axes, *probe, c);
    }
    return svg(
        str_cat("Mean irradiance of the volume over that of the referee, ", kChannelNames[channel],
                ", at ", report.probes.size(), " probes"),
        content + frame() +
            axis_names(str_cat("referee, ", kChannelNames[channel], " (lux)"), "volume (lux)"));
}

std::string probe_map(const VerifyReport& report) {
    std::vector<MapMark> marks;
    for (const VerifyProbe* probe : drawn_elements(
             report.probes, [](const VerifyProbe& p) { return std::abs(largest_z(p)); })) {
        const double z = largest_z(*probe);
        marks.push_back({probe->position, z / 4.0, std::abs(z) > 3.0,
                         str_cat("probe ", probe->probe, " at ", position_text(probe->position),
                                 ", z ", fixed_point(z, 2))});
    }
    return map_svg(str_cat("Map of ", marks.size(), " probes from above, coloured by z"), marks);
}

std::string place_map(const VerifyReport& report) {
    const double mean = report.mean_light > 0.0 ? report.mean_light : 1.0;
    std::vector<MapMark> marks;
    for (const VerifyPlace* place : drawn_elements(report.places, [](const VerifyPlace& p) {
             return std::abs(luminance_difference(p));
         })) {
        const double difference = luminance_difference(*place) / mean;
        marks.push_back({place->position, difference / 0.4, place->is_leak || place->is_unseen,
                         str_cat("place at ", position_text(place->position), ", difference ",
                                 percent_text(difference), " of the mean light")});
    }
    return map_svg(str_cat("Map of ", marks.size(),
                           " places from above, coloured by the difference of their light"),
                   marks);
}

}  // namespace tetralight
