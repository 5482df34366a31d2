// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/score_bars.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "clients/evaluator/html_text.h"
#include "clients/evaluator/markdown.h"
#include "clients/evaluator/systems.h"

namespace dhpmap::evaluator {
namespace {

using Value = std::optional<double>;

/// A column: its name, a system's value, and its format.
struct Column {
  const char* name;
  Value (*value)(const Experiment& experiment, const Scores& scores);
  int decimals;
  bool is_share;  ///< 0..1, higher is better, with a bar; else lower is better
};

constexpr double kOneHalf = 0.5;

Value PrecisionOf(const Scores& scores, const Protocol& protocol) {
  for (std::size_t i = 0; i < scores.precisions.size(); ++i) {
    if (protocol.precision_ious[i] == kOneHalf) return scores.precisions[i].mean;
  }
  return std::nullopt;
}

Value AskedPq(const Experiment& experiment, const Scores& scores) {
  for (const Scores& asked : experiment.asked) {
    if (asked.system == scores.system) return asked.panoptics.all.pq;
  }
  return std::nullopt;
}

constexpr Column kColumns[] = {
    {"PQ", [](const Experiment&, const Scores& s) { return Value(s.panoptics.all.pq); }, 3, true},
    {"mIoU", [](const Experiment&, const Scores& s) { return Value(s.semantics.mean_iou); }, 3, true},
    {"accuracy", [](const Experiment&, const Scores& s) { return Value(s.semantics.accuracy); }, 3, true},
    {"mAP-0.5", [](const Experiment& e, const Scores& s) { return PrecisionOf(s, e.protocol); }, 3, true},
    {"PQ, asked", AskedPq, 3, true},
    {"precision", [](const Experiment&, const Scores& s) { return Value(s.geometry.precision); }, 3, true},
    {"recall", [](const Experiment&, const Scores& s) { return Value(s.geometry.recall); }, 3, true},
    {"C-L1 (mm)", [](const Experiment&, const Scores& s) { return Value(1000 * s.geometry.chamfer_l1_m()); }, 1, false},
    {"ms a frame",
     [](const Experiment&, const Scores& s) {
       const auto num_frames = static_cast<double>(s.times.num_frames);
       return num_frames > 0 ? Value(1000 * s.times.integrate_s / num_frames) : std::nullopt;
     },
     1, false},
};

/// The value as displayed, so that equal numbers rank equally.
double Shown(const Column& column, double value) {
  const double scale = std::pow(10, column.decimals);
  return std::round(value * scale) / scale;
}

Value Best(const Column& column, const Experiment& experiment, const std::vector<const Scores*>& systems) {
  Value best;
  for (const Scores* scores : systems) {
    const Value value = column.value(experiment, *scores);
    if (value && std::isfinite(*value) && (!best || (column.is_share ? *value > *best : *value < *best))) best = value;
  }
  return best;
}

std::string Cell(const Column& column, const Value& value, const Value& best) {
  if (!value) return "<td class=\"n\">-</td>";
  const bool is_best = best && Shown(column, *value) == Shown(column, *best);
  std::string style = column.is_share ? "n bar" : "n";
  if (is_best) style += " best";
  const double width = 100 * std::clamp(*value, 0.0, 1.0);
  const std::string bar = column.is_share ? " style=\"--w:calc((100% - 12px)*" + Decimals(width / 100, 3) + ")\"" : "";
  return "<td class=\"" + style + "\"" + bar + ">" + Decimals(*value, column.decimals) + "</td>";
}

}  // namespace

std::string ScoreBars(const Experiment& experiment, const std::vector<const Scores*>& ranked) {
  std::string html = "<div class=\"scroll\"><table><tr><th>system</th>";
  for (const Column& column : kColumns) html += std::string("<th class=\"n\">") + column.name + "</th>";
  html += "</tr>\n";
  for (const Scores* scores : ranked) {
    html +=
        "<tr><td>" + Escaped(scores->system) + "<small>" + Escaped(SystemDescription(scores->system)) + "</small></td>";
    for (const Column& column : kColumns) {
      html += Cell(column, column.value(experiment, *scores), Best(column, experiment, ranked));
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

}  // namespace dhpmap::evaluator
