// SPDX-License-Identifier: MIT
// Charts as SVG text that stands in a page by itself.
#pragma once
#include <string>
#include <vector>

namespace lodestir {

struct ChartPoint {
    double x = 0, y = 0;
    double low = 0, high = 0;    ///< of y's interval; NaN: none is drawn
    double left = 0, right = 0;  ///< of x's; NaN: none is drawn
    std::string about;           ///< shown when the pointer rests on it
};

struct ChartSeries {
    std::string name;
    std::vector<ChartPoint> points;  ///< joined in this order
};

struct LineChart {
    std::string title, xLabel, yLabel;  ///< labels with units
    bool logX = false, logY = false;
    std::vector<ChartSeries> series;
};

/// Points that cannot be drawn (not finite, or not above 0 on a logarithmic axis) are left out and counted below the chart.
std::string drawLines(const LineChart& chart);

struct BarPart {
    std::string name;
    double value = 0;
};
struct Bar {
    std::string name;
    std::vector<BarPart> parts;
};

/// Stacked horizontal bars from 0; parts of one name have one colour.
std::string drawBars(const std::string& title, const std::string& xLabel, const std::vector<Bar>& bars);

struct Interval {
    std::string name, about;
    double value = 0, halfWidth = 0;
    bool good = true;  ///< else it is drawn in the colour of a warning
};

/// Horizontal intervals, one below the other, with a line at 0 and a band from -band to +band.
std::string drawIntervals(const std::string& title, const std::string& xLabel, const std::vector<Interval>& intervals, double band);

/// A grid of squares, row by row from the top, coloured from blue (-largest) over white (0) to red (+largest), each with its value when the
/// pointer rests on it.
std::string drawGrid(const std::string& title, int columns, const std::vector<double>& values, double largest);

/// Text with the characters escaped that mean something in HTML and SVG.
std::string escapeHtml(const std::string& text);

}  // namespace lodestir
