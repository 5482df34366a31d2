// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/report.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "clients/command_line/version.h"
#include "clients/evaluator/class_chart.h"
#include "clients/evaluator/html_text.h"
#include "clients/evaluator/markdown.h"
#include "clients/evaluator/output.h"
#include "clients/evaluator/report_style.h"
#include "clients/evaluator/score_bars.h"
#include "clients/evaluator/systems.h"

namespace dhpmap::evaluator {
namespace {

/// Distinguishable with colour blindness; repeated from the ninth system on.
constexpr std::array kSystemColors = {"#2458d3", "#e8752a", "#12a594", "#a83279",
                                      "#8a8f98", "#e5b800", "#6a4fd0", "#4a5a23"};

/// The system with the best PQ first.
std::vector<const Scores*> Ranked(const std::vector<Scores>& systems) {
  std::vector<const Scores*> ranked;
  for (const Scores& scores : systems) ranked.push_back(&scores);
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Scores* a, const Scores* b) { return a->panoptics.all.pq > b->panoptics.all.pq; });
  return ranked;
}

const char* ColorOf(std::size_t rank) { return kSystemColors[rank % kSystemColors.size()]; }

std::string Figure(const Picture& picture, const std::string& what) {
  return "<figure><label><input type=\"checkbox\" aria-label=\"enlarge\">" + InlineImage(picture, what) +
         "</label><figcaption>" + Escaped(what) + "</figcaption></figure>\n";
}

std::string LegendEntry(const std::string& color, const std::string& what) {
  return "<span><i style=\"background:" + color + "\"></i>" + Escaped(what) + "</span>";
}

std::string Css(Color c) {
  return "rgb(" + std::to_string(c.r) + "," + std::to_string(c.g) + "," + std::to_string(c.b) + ")";
}

/// "1,082,977".
std::string WithCommas(std::int64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string Tile(const std::string& value, const std::string& what) {
  return "<div class=\"tile\"><b>" + value + "</b><span class=\"soft\">" + what + "</span></div>\n";
}

std::string Hero(const Experiment& experiment, const Scores& best, const ReportPictures& pictures) {
  std::ostringstream html;
  html << "<section class=\"card hero\"><div><h1>" << Escaped(DatasetName(experiment.directory))
       << "</h1><p class=\"soft\">" << experiment.num_frames << " frames, " << experiment.labels
       << " labels, voxels of " << Decimals(100 * experiment.config.voxel_size_m, 0) << " cm. Judged at "
       << WithCommas(experiment.num_truth_points)
       << " places that the sensor measured, by the data set's own labels. Best: <b>" << Escaped(best.system)
       << "</b>.</p><div class=\"tiles\">" << Tile(Decimals(best.panoptics.all.pq, 3), "panoptic quality (PQ)")
       << Tile(Decimals(best.semantics.mean_iou, 3), "mean IoU of classes")
       << Tile(Decimals(100 * best.semantics.accuracy, 1) + " %", "places with the right class")
       << Tile(Decimals(1000 * best.geometry.chamfer_l1_m(), 1) + " mm", "mean distance, map and measured points")
       << "</div></div>\n"
       << Figure(pictures.seen().corner, "As the camera saw it") << "</section>\n";
  return html.str();
}

std::string SystemSection(const PicturePair& truth, const ReportPictures::OfSystem& system) {
  return "<section class=\"card\"><h3>" + Escaped(system.system) + " <small>" +
         Escaped(SystemDescription(system.system)) + "</small></h3><div class=\"views\">\n" +
         Figure(truth.corner, "Truth") + Figure(system.labels.corner, "Map") + Figure(system.errors.corner, "Errors") +
         Figure(truth.above, "Truth, from above") + Figure(system.labels.above, "Map, from above") +
         Figure(system.errors.above, "Errors, from above") + "</div></section>\n";
}

std::string Pictures(const std::vector<const Scores*>& ranked, const ReportPictures& pictures) {
  using namespace error_colors;
  std::string html =
      "<h2>Truth, map, errors</h2>\n<p class=\"soft\">Things have strong colours, one each; backgrounds are pale. "
      "What matches the truth has its colour. All is shown on the surface that the true labels give; surfaces that "
      "only a "
      "system has are in the numbers alone. Select a picture to enlarge it.</p><div class=\"legend\">" +
      LegendEntry(Css(kRight), "right") + LegendEntry(Css(kWrongClass), "wrong class") +
      LegendEntry(Css(kWrongInstance), "right class, its object or area not matched") +
      LegendEntry(Css(kMissing), "no answer") + LegendEntry(Css(kNotJudged), "not judged") + "</div>\n";
  for (const Scores* scores : ranked) {
    for (const ReportPictures::OfSystem& system : pictures.systems()) {
      if (system.system == scores->system) html += SystemSection(pictures.truth(), system);
    }
  }
  return html;
}

std::optional<double> PqOf(const Scores& scores, std::size_t class_index) {
  const ClassPanoptic& panoptic = scores.panoptics.classes[class_index];
  return panoptic.is_present ? std::optional(panoptic.pq()) : std::nullopt;
}

/// Classes sorted by the best system's IoU; better systems are drawn on top.
ClassChart ChartOf(const Experiment& experiment, const std::vector<const Scores*>& ranked) {
  ClassChart chart{.measures = {"PQ", "IoU"}, .systems = {}, .colors = {}, .rows = {}};
  for (std::size_t s = ranked.size(); s-- > 0;) {
    chart.systems.push_back(ranked[s]->system);
    chart.colors.emplace_back(ColorOf(s));
  }
  const auto& counts = ranked.front()->semantics.classes;
  std::vector<std::size_t> present;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (counts[c].num_truth > 0) present.push_back(c);
  }
  std::stable_sort(present.begin(), present.end(),
                   [&counts](std::size_t a, std::size_t b) { return counts[a].iou() > counts[b].iou(); });
  for (const std::size_t c : present) {
    ChartRow row{.name = experiment.classes.classes()[c].name, .values = {{}, {}}};
    for (std::size_t s = ranked.size(); s-- > 0;) {
      row.values[0].push_back(PqOf(*ranked[s], c));
      row.values[1].emplace_back(ranked[s]->semantics.classes[c].iou());
    }
    chart.rows.push_back(std::move(row));
  }
  return chart;
}

std::string ByClass(const Experiment& experiment, const std::vector<const Scores*>& ranked) {
  std::string legend;
  for (std::size_t s = 0; s < ranked.size(); ++s) legend += LegendEntry(ColorOf(s), ranked[s]->system);
  return "<h2>By class</h2>\n<section class=\"card\"><div class=\"legend dots\">" + legend + "</div>\n" +
         SvgOf(ChartOf(experiment, ranked)) + "</section>\n";
}

std::string Folded(const std::string& summary, const std::string& content) {
  return "<details><summary>" + Escaped(summary) + "</summary>\n" + content + "</details>\n";
}

/// The protocol's paragraphs and its list.
std::string ProtocolHtml(const std::string& markdown) {
  std::istringstream lines(markdown);
  std::string html, line;
  bool is_list = false;
  while (std::getline(lines, line)) {
    if (line.empty()) continue;
    const bool is_item = line.starts_with("- ");
    if (is_item != is_list) html += is_item ? "<ul>" : "</ul>";
    is_list = is_item;
    html += is_item ? "<li>" + Escaped(line.substr(2)) + "</li>\n" : "<p>" + Escaped(line) + "</p>\n";
  }
  if (is_list) html += "</ul>\n";
  return html;
}

std::string Tables(const Experiment& experiment) {
  return "<h2>All numbers</h2>\n<section class=\"card\">\n" +
         Folded("At the points that the sensor measured", HtmlOfTable(PointsTable(experiment))) +
         Folded("Systems that were asked at the same points", HtmlOfTable(AskedTable(experiment))) +
         Folded("Against the map of the true labels", HtmlOfTable(ScoreTable(experiment))) +
         Folded("Classes, against the map of the true labels", HtmlOfTable(ClassTable(experiment))) +
         Folded("What was compared, and how", ProtocolHtml(ProtocolText(experiment))) + "</section>\n";
}

}  // namespace

void ReportPictures::Add(const TruthPictures& truth, const Scores& scores, const std::vector<ElementLabel>& labels) {
  if (systems_.empty()) {
    seen_ = truth.Seen();
    truth_ = truth.TruthLabels();
  }
  systems_.push_back({scores.system, truth.Labels(scores, labels), truth.Errors(scores, labels)});
}

std::string ReportPage(const Experiment& experiment, const ReportPictures& pictures) {
  const std::vector<const Scores*> ranked = Ranked(experiment.on_points);
  const std::string name = Escaped(DatasetName(experiment.directory));
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>" +
         name + ": maps against the truth</title><style>" + kReportStyle + "</style></head><body><main>\n" +
         (ranked.empty() ? "" : Hero(experiment, *ranked.front(), pictures)) +
         "<h2>Scores</h2>\n<section class=\"card\">" + ScoreBars(experiment, ranked) + "</section>\n" +
         Pictures(ranked, pictures) + (ranked.empty() ? "" : ByClass(experiment, ranked)) + Tables(experiment) +
         "<p class=\"soft\">Made by " + VersionOf("dhpmap-evaluate") +
         ". Panmap and Kimera are our own implementations of their published recipes, on the same frames.</p>\n"
         "</main></body></html>\n";
}

}  // namespace dhpmap::evaluator
