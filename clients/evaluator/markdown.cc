// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/markdown.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "clients/evaluator/truth_points.h"

namespace dhpmap::evaluator {
namespace {

std::string Ids(const std::vector<std::uint32_t>& ids) {
  std::string text;
  for (const std::uint32_t id : ids) text.append(text.empty() ? "" : " ").append(std::to_string(id));
  return text.empty() ? "-" : text;
}

std::string MeanPerFrame_ms(const SystemTimes& times, double seconds) {
  return times.num_frames == 0 ? "-" : Decimals(1000 * seconds / static_cast<double>(times.num_frames), 1);
}

/// Indices of the classes that the ground truth has.
std::vector<std::size_t> PresentClasses(const Experiment& experiment) {
  std::vector<std::size_t> present;
  if (experiment.systems.empty()) return present;
  const auto& counts = experiment.systems.front().semantics.classes;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (counts[c].num_truth > 0) present.push_back(c);
  }
  return present;
}

}  // namespace

std::string MarkdownTable::Text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 3);
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::ostringstream out;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < widths.size(); ++c) {
      const std::string cell = c < rows_[r].size() ? rows_[r][c] : "";
      const std::string padding(widths[c] - cell.size(), ' ');
      out << "| " << (c < num_left_ ? cell + padding : padding + cell) << ' ';
    }
    out << "|\n";
    if (r > 0) continue;
    for (std::size_t c = 0; c < widths.size(); ++c) {
      out << '|' << std::string(widths[c] + 1, '-') << (c < num_left_ ? '-' : ':');
    }
    out << "|\n";
  }
  return out.str();
}

std::string Decimals(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

std::string ProtocolText(const Experiment& experiment) {
  const Protocol& p = experiment.protocol;
  std::ostringstream out;
  out << "Data set `" << experiment.directory << "`, " << experiment.labels << " labels, " << experiment.num_frames
      << " frames";
  if (experiment.num_skipped > 0) out << " (" << experiment.num_skipped << " could not be read)";
  out << ", voxels of " << Decimals(experiment.config.voxel_size_m, 3) << " m.\n\n"
      << "- Truth of the first two tables: what the sensor measured, with the data set's labels; "
      << experiment.num_truth_points << " elements, one a cell of " << Decimals(TruthPoints::kCameraCell_m, 2)
      << " m (depth images) or " << Decimals(TruthPoints::kScanCell_m, 2) << " m (scans).\n"
      << "- Truth of the last: map of the ground truth's labels by the same fusion, each place the object's that was "
         "seen there most; "
      << experiment.num_truth_samples << " samples of its triangles, one every " << Decimals(p.spacing_m, 3)
      << " m squared.\n"
      << "- An element has the label of the nearest sample of the system's surface within " << Decimals(p.d_match_m, 3)
      << " m, else none.\n"
      << "- All surface: where a system has one farther than that from any element, its label is wrong, for as many "
         "elements as there are on as much surface; so is what lies in gaps between points.\n"
      << "- Asked: what a system says of the element's point, by the voxel that holds it, if that has a surface within "
         "the truncation (QueryPoints); systems that answer no points are left out.\n"
      << "- Segments match above IoU 0.5; unmatched ones below " << experiment.points_protocol.min_elements
      << " elements, in the last table " << p.min_elements << " samples, are ignored.\n"
      << "- Geometry: distance of each element to the triangle of the system's nearest sample; of each of those to the "
         "nearest element, gaps between points included, in the last table to the nearest triangle; F-score at "
      << Decimals(p.geometry.threshold_m, 3) << " m; accuracy ignores distances above "
      << Decimals(p.geometry.accuracy_truncation_m, 2) << " m, completion clips them at "
      << Decimals(p.geometry.completion_truncation_m, 2) << " m; one with a label is covered by a surface within "
      << Decimals(p.d_match_m, 2) << " m.\n"
      << "- Classes (ground truth ids = predicted ids):";
  bool first = true;
  for (const std::size_t c : PresentClasses(experiment)) {
    const EvaluatedClass& evaluated = experiment.classes.classes()[c];
    out << (first ? " " : "; ") << evaluated.name << (evaluated.is_thing ? "" : " (stuff)") << ' '
        << Ids(evaluated.truth_ids) << " = " << Ids(evaluated.predicted_ids);
    first = false;
  }
  out << ".\n";
  return out.str();
}

namespace {

std::vector<std::string> LabelHeader(const Protocol& protocol) {
  std::vector<std::string> header{"system", "PQ", "SQ", "RQ", "PQ things", "PQ stuff", "mIoU", "accuracy", "answered"};
  for (const double iou : protocol.precision_ious) header.push_back("mAP-" + Decimals(iou, 1));
  return header;
}

std::vector<std::string> LabelCells(const Scores& s, const Protocol& protocol) {
  const PanopticScore& p = s.panoptics;
  const double num_elements = std::max<double>(1, static_cast<double>(s.semantics.num_elements));
  std::vector<std::string> row{s.system,
                               Decimals(p.all.pq, 3),
                               Decimals(p.all.sq, 3),
                               Decimals(p.all.rq, 3),
                               Decimals(p.things.pq, 3),
                               Decimals(p.stuff.pq, 3),
                               Decimals(s.semantics.mean_iou, 3),
                               Decimals(s.semantics.accuracy, 3),
                               Decimals(static_cast<double>(s.semantics.num_answered) / num_elements, 3)};
  for (std::size_t i = 0; i < protocol.precision_ious.size(); ++i) {
    row.push_back(i < s.precisions.size() ? Decimals(s.precisions[i].mean, 3) : "-");
  }
  return row;
}

/// `has_all_surface`: adds scores that penalise false surface.
std::string TableOf(const std::vector<Scores>& systems, const Protocol& protocol, bool has_all_surface) {
  std::vector<std::string> header = LabelHeader(protocol);
  if (has_all_surface) header.insert(header.end(), {"PQ, all surface", "mIoU, all surface"});
  for (const char* name : {"Acc. m", "Comp. m", "C-L1 m", "precision %", "recall %", "F-score %", "covered %",
                           "ms/frame", "refine ms/frame", "finish s"}) {
    header.emplace_back(name);
  }
  MarkdownTable table(header);
  for (const Scores& s : systems) {
    std::vector<std::string> row = LabelCells(s, protocol);
    if (has_all_surface) {
      row.push_back(Decimals(s.with_false.pq, 3));
      row.push_back(Decimals(s.with_false.mean_iou, 3));
    }
    for (const double metres : {s.geometry.accuracy_m, s.geometry.completion_m, s.geometry.chamfer_l1_m()}) {
      row.push_back(Decimals(metres, 4));
    }
    for (const double share : {s.geometry.precision, s.geometry.recall, s.geometry.f_score(), s.geometry.covered}) {
      row.push_back(Decimals(100 * share, 2));
    }
    row.push_back(MeanPerFrame_ms(s.times, s.times.integrate_s));
    row.push_back(MeanPerFrame_ms(s.times, s.times.refine_s));
    row.push_back(Decimals(s.times.finish_s, 2));
    table.Add(std::move(row));
  }
  return table.Text();
}

}  // namespace

std::string AskedTable(const Experiment& experiment) {
  MarkdownTable table(LabelHeader(experiment.protocol));
  for (const Scores& s : experiment.asked) table.Add(LabelCells(s, experiment.protocol));
  return table.Text();
}

std::string ScoreTable(const Experiment& experiment) { return TableOf(experiment.systems, experiment.protocol, false); }
std::string PointsTable(const Experiment& experiment) {
  return TableOf(experiment.on_points, experiment.protocol, true);
}

std::string ClassTable(const Experiment& experiment) {
  std::vector<std::string> header{"class", "samples"};
  for (const Scores& s : experiment.systems) {
    header.push_back("IoU " + s.system);
    header.push_back("PQ " + s.system);
    header.push_back("TP/FP/FN");
  }
  MarkdownTable table(header);
  for (const std::size_t c : PresentClasses(experiment)) {
    std::vector<std::string> row{experiment.classes.classes()[c].name,
                                 std::to_string(experiment.systems.front().semantics.classes[c].num_truth)};
    for (const Scores& s : experiment.systems) {
      const ClassPanoptic& p = s.panoptics.classes[c];
      row.push_back(Decimals(s.semantics.classes[c].iou(), 3));
      row.push_back(p.is_present ? Decimals(p.pq(), 3) : "-");
      row.push_back(std::to_string(p.num_matched) + "/" + std::to_string(p.num_false) + "/" +
                    std::to_string(p.num_missed));
    }
    table.Add(std::move(row));
  }
  return table.Text();
}

}  // namespace dhpmap::evaluator
