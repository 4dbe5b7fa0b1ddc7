// SPDX-License-Identifier: MIT
#include <framework/study/report/chart.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lodestir {
namespace {

/// Told apart by the colour-blind, too (Okabe and Ito, "Color universal design", 2008).
constexpr std::array<const char*, 7> colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#4d4d4d"};
constexpr std::array<const char*, 3> dashes{"none", "6 3", "2 3"};

constexpr double width = 600, plotHeight = 300, left = 76, right = 18, top = 40, legendLine = 18;

const char* colorOf(std::size_t index) { return colors[index % colors.size()]; }
const char* dashOf(std::size_t index) { return dashes[index / colors.size() % dashes.size()]; }

std::string tickText(double value) {
    const double size = std::abs(value);
    if (value == 0 || (size >= 0.001 && size < 100000)) return fmt::format("{:.6g}", value);
    const int exponent = int(std::floor(std::log10(size) + 1e-9));
    const double mantissa = value / std::pow(10.0, exponent);
    const std::string power = fmt::format("10<tspan dy=\"-5\" font-size=\"9\">{}</tspan>", exponent);
    return std::abs(mantissa - 1) < 1e-6 ? power : fmt::format("{:.3g}×{}", mantissa, power);
}

/// One axis: from values to pixels.
class Axis {
public:
    Axis(bool isLog, double first, double last) : log_(isLog), first_(first), last_(last) {}

    void include(double value) {
        if (!std::isfinite(value) || (log_ && value <= 0)) return;
        low_ = std::min(low_, scaled(value));
        high_ = std::max(high_, scaled(value));
    }
    void finish(bool fromZero = false) {
        if (low_ > high_) low_ = 0, high_ = 1;
        if (fromZero) low_ = std::min(low_, 0.0);
        if (high_ - low_ < 1e-12 * (1 + std::abs(high_))) low_ -= 0.5, high_ += 0.5;
        const double margin = 0.06 * (high_ - low_);
        if (!fromZero || low_ < 0) low_ -= margin;
        high_ += margin;
    }
    bool holds(double value) const { return std::isfinite(value) && (!log_ || value > 0); }
    double at(double value) const {
        const double share = !holds(value) ? 0 : std::clamp((scaled(value) - low_) / (high_ - low_), 0.0, 1.0);
        return first_ + share * (last_ - first_);
    }
    std::vector<double> ticks() const {
        std::vector<double> all;
        if (!log_) {
            const double raw = (high_ - low_) / 6, power = std::pow(10.0, std::floor(std::log10(raw)));
            double step = power;
            for (const double nice : {1.0, 2.0, 5.0, 10.0})
                if (step < raw) step = nice * power;
            for (double i = std::ceil(low_ / step - 1e-9); i * step <= high_ + 1e-9 * step; ++i) all.push_back(i * step + 0.0);
            return all;
        }
        const double decades = high_ - low_;
        const int every = std::max(1, int(std::ceil(decades / 8)));
        for (int power = int(std::floor(low_)); power <= int(std::ceil(high_)); ++power)
            for (const double mantissa : {1.0, 2.0, 3.0, 5.0}) {
                if (mantissa != 1 && (decades > 2.2 || (mantissa == 3 && decades > 0.8))) continue;
                if (mantissa == 1 && power % every != 0) continue;
                const double value = mantissa * std::pow(10.0, power);
                if (std::log10(value) >= low_ - 1e-9 && std::log10(value) <= high_ + 1e-9) all.push_back(value);
            }
        return all;
    }

private:
    double scaled(double value) const { return log_ ? std::log10(value) : value; }

    bool log_;
    double first_, last_;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

std::string open(double height, const std::string& title) {
    return fmt::format(
        "<svg viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" role=\"img\">\n"
        "<text x=\"{:.0f}\" y=\"20\" class=\"title\">{}</text>\n",
        width, height, width, height, left, escapeHtml(title));
}

std::string verticalGrid(const Axis& x, double bottom, const std::string& label) {
    std::string svg;
    for (const double tick : x.ticks())
        svg += fmt::format(
            "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" class=\"grid\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
            "class=\"tick\" text-anchor=\"middle\">{4}</text>\n",
            x.at(tick), top, bottom, bottom + 16, tickText(tick));
    return svg + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"label\" text-anchor=\"middle\">{}</text>\n",
                             (left + width - right) / 2, bottom + 36, escapeHtml(label));
}

/// Entries side by side as far as they fit. Returns the height used.
double drawLegend(std::string& svg, const std::vector<std::string>& names, double y, bool lines) {
    double x = left;
    const double start = y;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double needed = 44 + 6.6 * double(names[i].size());
        if (x > left && x + needed > width - right) x = left, y += legendLine;
        if (lines)
            svg += fmt::format(
                "<line x1=\"{0:.1f}\" y1=\"{2:.1f}\" x2=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" stroke-dasharray=\"{4}\" "
                "stroke-width=\"2\"/><circle cx=\"{5:.1f}\" cy=\"{2:.1f}\" r=\"3\" fill=\"{3}\"/>",
                x, x + 22, y - 4, colorOf(i), dashOf(i), x + 11);
        else
            svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"10\" fill=\"{}\"/>", x + 6, y - 9, colorOf(i));
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"tick\">{}</text>\n", x + 27, y, escapeHtml(names[i]));
        x += needed;
    }
    return y - start + legendLine;
}

}  // namespace

std::string escapeHtml(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += c;
    }
    return safe;
}

std::string drawLines(const LineChart& chart) {
    const double bottom = top + plotHeight;
    Axis x(chart.logX, left, width - right), y(chart.logY, bottom, top);
    std::size_t hidden = 0;
    const auto isDrawn = [&](const ChartPoint& p) { return x.holds(p.x) && y.holds(p.y); };
    for (const ChartSeries& series : chart.series)
        for (const ChartPoint& p : series.points) {
            if (!isDrawn(p)) {
                ++hidden;
                continue;
            }
            for (const double value : {p.x, p.left, p.right}) x.include(value);
            for (const double value : {p.y, p.low, p.high}) y.include(value);
        }
    x.finish();
    y.finish();

    std::string svg = verticalGrid(x, bottom, chart.xLabel);
    for (const double tick : y.ticks())
        svg += fmt::format(
            "<line x1=\"{0:.1f}\" y1=\"{2:.1f}\" x2=\"{1:.1f}\" y2=\"{2:.1f}\" class=\"grid\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" "
            "class=\"tick\" text-anchor=\"end\">{5}</text>\n",
            left, width - right, y.at(tick), left - 6, y.at(tick) + 4, tickText(tick));
    svg += fmt::format("<text transform=\"translate(16 {:.1f}) rotate(-90)\" class=\"label\" text-anchor=\"middle\">{}</text>\n",
                       (top + bottom) / 2, escapeHtml(chart.yLabel));
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\" class=\"frame\"/>\n", left, top, bottom, width - right);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        names.push_back(chart.series[i].name);
        std::string path, marks;
        for (const ChartPoint& p : chart.series[i].points) {
            if (!isDrawn(p)) continue;
            const double px = x.at(p.x), py = y.at(p.y);
            path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px, py);
            if (!std::isnan(p.low))
                marks += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\"/>", px, y.at(p.low), y.at(p.high));
            if (!std::isnan(p.left))
                marks +=
                    fmt::format("<line x1=\"{1:.1f}\" y1=\"{0:.1f}\" x2=\"{2:.1f}\" y2=\"{0:.1f}\"/>", py, x.at(p.left), x.at(p.right));
            marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.4\" fill=\"{}\"><title>{}</title></circle>\n", px, py,
                                 colorOf(i), escapeHtml(p.about));
        }
        svg += fmt::format(
            "<g stroke=\"{0}\" stroke-width=\"1.3\"><path d=\"{1}\" fill=\"none\" stroke-width=\"1.8\" "
            "stroke-dasharray=\"{2}\"/>\n{3}</g>\n",
            colorOf(i), path.empty() ? "M0 0" : path, dashOf(i), marks);
    }
    double end = bottom + 62;
    end += drawLegend(svg, names, end, true);
    if (hidden > 0) {
        svg += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"tick\">{} points without a place on these axes are in the table only.</text>\n", left,
            end, hidden);
        end += legendLine;
    }
    return open(end, chart.title) + svg + "</svg>\n";
}

std::string drawBars(const std::string& title, const std::string& xLabel, const std::vector<Bar>& bars) {
    constexpr double step = 24, thickness = 15;
    const double bottom = top + step * double(bars.size()) + 6;
    std::size_t longest = 0;
    for (const Bar& bar : bars) longest = std::max(longest, bar.name.size());
    const double start = std::clamp(12 + 6.4 * double(longest), left, width / 2);
    Axis x(false, start, width - right);
    std::vector<std::string> names;
    for (const Bar& bar : bars) {
        double sum = 0;
        for (const BarPart& part : bar.parts) {
            sum += part.value;
            if (std::ranges::find(names, part.name) == names.end()) names.push_back(part.name);
        }
        x.include(sum);
    }
    x.finish(true);
    std::string svg = verticalGrid(x, bottom, xLabel);
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const double y = top + 6 + step * double(i);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"tick\" text-anchor=\"end\">{}</text>\n", start - 8, y + 12,
                           escapeHtml(bars[i].name));
        double sum = 0;
        for (const BarPart& part : bars[i].parts) {
            const std::size_t color = std::size_t(std::ranges::find(names, part.name) - names.begin());
            svg += fmt::format(
                "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.0f}\" fill=\"{}\"><title>{}: {:.4g}</title></rect>\n",
                x.at(sum), y, x.at(sum + part.value) - x.at(sum), thickness, colorOf(color), escapeHtml(part.name), part.value);
            sum += part.value;
        }
    }
    svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}H{3:.1f}\" class=\"frame\"/>\n", start, top, bottom, width - right);
    double end = bottom + 62;
    end += drawLegend(svg, names, end, false);
    return open(end, title) + svg + "</svg>\n";
}

std::string drawIntervals(const std::string& title, const std::string& xLabel, const std::vector<Interval>& intervals, double band) {
    constexpr double step = 22;
    const double bottom = top + step * double(intervals.size()) + 6;
    std::size_t longest = 0;
    for (const Interval& interval : intervals) longest = std::max(longest, interval.name.size());
    const double start = std::clamp(12 + 6.4 * double(longest), left, width / 2);
    Axis x(false, start, width - right);
    for (const double value : {-band, band}) x.include(value);
    for (const Interval& interval : intervals)
        for (const double value : {interval.value - interval.halfWidth, interval.value + interval.halfWidth}) x.include(value);
    x.finish();
    std::string svg = fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#e8f3ee\"/>\n", x.at(-band),
                                  top, x.at(band) - x.at(-band), bottom - top);
    svg += verticalGrid(x, bottom, xLabel);
    svg += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"#444\"/>\n", x.at(0), top, bottom);
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        const Interval& interval = intervals[i];
        const double y = top + 14 + step * double(i);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"tick\" text-anchor=\"end\">{}</text>\n", start - 8, y + 4,
                           escapeHtml(interval.name));
        if (!std::isfinite(interval.value)) continue;
        svg += fmt::format(
            "<g stroke=\"{0}\" stroke-width=\"1.8\"><line x1=\"{1:.1f}\" y1=\"{3:.1f}\" x2=\"{2:.1f}\" y2=\"{3:.1f}\"/><circle "
            "cx=\"{4:.1f}\" "
            "cy=\"{3:.1f}\" r=\"3.4\" fill=\"{0}\"><title>{5}</title></circle></g>\n",
            interval.good ? colors[2] : colors[1], x.at(interval.value - interval.halfWidth), x.at(interval.value + interval.halfWidth), y,
            x.at(interval.value), escapeHtml(interval.about));
    }
    return open(bottom + 48, title) + svg + "</svg>\n";
}

std::string drawGrid(const std::string& title, int columns, const std::vector<double>& values, double largest) {
    constexpr double cell = 22;
    const auto rows = (values.size() + std::size_t(columns) - 1) / std::size_t(columns);
    std::string svg = fmt::format("<figure><svg viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\">\n",
                                  cell * columns, cell * double(rows));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double share = std::clamp(values[i] / largest, -1.0, 1.0);
        const int fade = std::isfinite(values[i]) ? int(255 * (1 - std::abs(share))) : 0;
        svg += fmt::format(
            "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"rgb({},{},{})\" stroke=\"#ccc\"><title>({}, {}): "
            "{:+.2f}"
            "</title></rect>\n",
            cell * double(i % std::size_t(columns)), cell * double(i / std::size_t(columns)), cell, cell, share > 0 ? 255 : fade, fade,
            share < 0 ? 255 : fade, i % std::size_t(columns), i / std::size_t(columns), values[i]);
    }
    return svg + fmt::format("</svg><figcaption>{}</figcaption></figure>\n", escapeHtml(title));
}

}  // namespace lodestir
