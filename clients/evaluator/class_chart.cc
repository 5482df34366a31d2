// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/class_chart.h"

#include <algorithm>

#include "clients/evaluator/html_text.h"
#include "clients/evaluator/markdown.h"

namespace dhpmap::evaluator {
namespace {

constexpr double kNames = 150, kPanel = 420, kGap = 40, kRow = 22, kTop = 42, kBottom = 12, kDot = 5;

std::string Number(double value) { return Decimals(value, 1); }

double XOf(std::size_t panel, double value) {
  return kNames + static_cast<double>(panel) * (kPanel + kGap) + std::clamp(value, 0.0, 1.0) * kPanel;
}

std::string Line(double x1, double y1, double x2, double y2, const char* style) {
  return std::string("<line class=\"") + style + "\" x1=\"" + Number(x1) + "\" y1=\"" + Number(y1) + "\" x2=\"" +
         Number(x2) + "\" y2=\"" + Number(y2) + "\"/>";
}

std::string Text(double x, double y, const char* style, const std::string& text) {
  return std::string("<text class=\"") + style + "\" x=\"" + Number(x) + "\" y=\"" + Number(y) + "\">" + Escaped(text) +
         "</text>";
}

std::string Grid(const ClassChart& chart, std::size_t panel, double bottom) {
  std::string svg = Text(XOf(panel, 0.5), 12, "measure", chart.measures[panel]);
  for (const double value : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    svg += Line(XOf(panel, value), kTop - 6, XOf(panel, value), bottom, "grid");
    svg += Text(XOf(panel, value), kTop - 10, "tick", Decimals(value, value == 0 || value == 1 ? 0 : 2));
  }
  return svg;
}

/// The range of all systems as a line, and a dot for each.
std::string Dots(const ClassChart& chart, const ChartRow& row, std::size_t panel, double y) {
  double low = 1, high = 0;
  std::string dots;
  for (std::size_t s = 0; s < chart.systems.size(); ++s) {
    const std::optional<double>& value = row.values[panel][s];
    if (!value) continue;
    low = std::min(low, *value);
    high = std::max(high, *value);
    dots += "<circle cx=\"" + Number(XOf(panel, *value)) + "\" cy=\"" + Number(y) + "\" r=\"" + Number(kDot) +
            "\" fill=\"" + chart.colors[s] + "\"><title>" + Escaped(row.name) + ", " + chart.measures[panel] + " of " +
            Escaped(chart.systems[s]) + ": " + Decimals(*value, 3) + "</title></circle>";
  }
  return (low < high ? Line(XOf(panel, low), y, XOf(panel, high), y, "span") : "") + dots;
}

}  // namespace

std::string SvgOf(const ClassChart& chart) {
  const double bottom = kTop + kRow * static_cast<double>(chart.rows.size());
  const auto panels = static_cast<double>(chart.measures.size());
  const double width = kNames + panels * kPanel + (panels - 1) * kGap + 2 * kDot;
  std::string svg = "<svg class=\"chart\" viewBox=\"0 0 " + Number(width) + " " + Number(bottom + kBottom) +
                    "\" role=\"img\" aria-label=\"scores by class\">\n";
  for (std::size_t panel = 0; panel < chart.measures.size(); ++panel) svg += Grid(chart, panel, bottom) + "\n";
  for (std::size_t r = 0; r < chart.rows.size(); ++r) {
    const double y = kTop + kRow * (static_cast<double>(r) + 0.5);
    svg += Text(kNames - 14, y + 4, "name", chart.rows[r].name);
    for (std::size_t panel = 0; panel < chart.measures.size(); ++panel) {
      svg += Line(XOf(panel, 0), y, XOf(panel, 1), y, "row") + Dots(chart, chart.rows[r], panel, y);
    }
    svg += "\n";
  }
  return svg + "</svg>\n";
}

}  // namespace dhpmap::evaluator
