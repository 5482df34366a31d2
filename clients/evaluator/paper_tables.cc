// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/paper_tables.h"

#include <algorithm>
#include <optional>

#include "clients/evaluator/markdown.h"
#include "clients/evaluator/output.h"
#include "clients/evaluator/paper_numbers.h"

namespace dhpmap::evaluator {
namespace {

const Scores* Find(const Experiment& experiment, const std::string& system) {
  const auto it = std::find_if(experiment.systems.begin(), experiment.systems.end(),
                               [&system](const Scores& scores) { return scores.system == system; });
  return it == experiment.systems.end() ? nullptr : &*it;
}

std::string Cell(std::optional<double> ours, std::optional<double> paper, int decimals) {
  const std::string text = ours ? Decimals(*ours, decimals) : "-";
  return paper ? text + " (" + Decimals(*paper, decimals) + ")" : text;
}

/// Calls add(experiment, scores, row of the paper) for each system that was run, for one data set after the other.
template <typename Add>
void ForEach(const std::vector<Experiment>& experiments, const std::vector<std::string>& systems, const Add& add) {
  static constexpr PaperRow kNothing{};
  for (const Experiment& experiment : experiments) {
    for (const std::string& system : systems) {
      const Scores* scores = Find(experiment, system);
      const PaperRow* paper = FindPaperRow(experiment.preset, system);
      if (scores != nullptr) add(experiment, *scores, paper == nullptr ? kNothing : *paper);
    }
  }
}

std::string Milliseconds(double seconds) { return Decimals(1000 * seconds, seconds < 1e-3 ? 6 : 2); }

double PerFrame_ms(const Scores& scores, double seconds) {
  return scores.times.num_frames == 0 ? 0.0 : 1000 * seconds / static_cast<double>(scores.times.num_frames);
}

}  // namespace

std::vector<std::string> PaperSystems() {
  return {"panmap", "kimera", "votes", "dhp_no_refine", "dhp_management_only", "dhp_crf_only", "dhp"};
}

std::string LabelTable(const std::vector<Experiment>& experiments) {
  MarkdownTable table({"data set", "method", "PQ", "RQ", "SQ", "mIoU", "accuracy", "mAP-0.3", "mAP-0.4", "mAP-0.5"}, 2);
  const auto add = [&table](const Experiment& experiment, const Scores& s, const PaperRow& paper) {
    std::vector<std::string> row{DatasetName(experiment.directory),
                                 s.system + (s.has_instances ? "" : "*"),
                                 Cell(s.panoptics.all.pq, paper.pq, 3),
                                 Cell(s.panoptics.all.rq, paper.rq, 3),
                                 Cell(s.panoptics.all.sq, paper.sq, 3),
                                 Cell(s.semantics.mean_iou, paper.mean_iou, 3),
                                 Cell(s.semantics.accuracy, paper.accuracy, 3)};
    for (std::size_t i = 0; i < paper.mean_precision.size(); ++i) {
      std::optional<double> ours;
      if (i < s.precisions.size()) ours = s.precisions[i].mean;
      row.push_back(Cell(ours, paper.mean_precision[i], 3));
    }
    table.Add(std::move(row));
  };
  ForEach(experiments, {"panmap", "votes", "dhp_no_refine", "dhp"}, add);
  return table.Text();
}

std::string KimeraTable(const std::vector<Experiment>& experiments) {
  MarkdownTable table({"data set", "method", "mIoU", "accuracy"}, 2);
  ForEach(experiments, {"kimera", "votes", "dhp"}, [&table](const auto& experiment, const auto& s, const auto& paper) {
    table.Add({DatasetName(experiment.directory), s.system, Cell(s.semantics.mean_iou, paper.mean_iou, 3),
               Cell(s.semantics.accuracy, paper.accuracy, 3)});
  });
  return table.Text();
}

std::string GeometryTable(const std::vector<Experiment>& experiments) {
  MarkdownTable table({"data set", "method", "Acc. (m)", "Comp. (m)", "C-L1 (m)", "F-score (%)", "at (m)"}, 2);
  ForEach(experiments, {"kimera", "panmap", "dhp"}, [&table](const auto& experiment, const auto& s, const auto& paper) {
    table.Add({DatasetName(experiment.directory), s.system, Cell(s.geometry.accuracy_m, paper.accuracy_m, 4),
               Cell(s.geometry.completion_m, paper.completion_m, 4),
               Cell(s.geometry.chamfer_l1_m(), paper.chamfer_l1_m, 4),
               Cell(100 * s.geometry.f_score(), paper.f_score_percent, 2),
               Decimals(experiment.protocol.geometry.threshold_m, 2)});
  });
  return table.Text();
}

std::string RetrievalTable(const std::vector<RetrievalTimes>& retrievals) {
  MarkdownTable table({"scene voxels", "object voxels", "flat TSDF, traversal (ms)", "by id, blocks at hand (ms)",
                       "by id, all voxels copied (ms)", "flat (MiB)", "submaps (MiB)"});
  constexpr double kMiB = 1024.0 * 1024.0;
  for (const RetrievalTimes& r : retrievals) {
    table.Add({std::to_string(r.scene.num_voxels), std::to_string(r.scene.num_object_voxels),
               Cell(1000 * r.traversal_s, r.scene.paper_ms, 1), Milliseconds(r.find_s), Milliseconds(r.copy_s),
               Decimals(static_cast<double>(r.flat_bytes) / kMiB, 0),
               Decimals(static_cast<double>(r.map_bytes) / kMiB, 0)});
  }
  return table.Text();
}

std::string AblationTable(const std::vector<Experiment>& experiments) {
  MarkdownTable table({"data set", "refinement", "PQ", "SQ", "RQ", "mIoU", "accuracy", "mAP-0.5", "mapping ms/frame",
                       "refinement ms/frame", "finish (s)"},
                      2);
  const std::vector<std::pair<std::string, std::string>> variants{{"dhp_no_refine", "none"},
                                                                  {"dhp_management_only", "management only"},
                                                                  {"dhp_crf_only", "CRF only"},
                                                                  {"dhp", "both"}};
  for (const Experiment& experiment : experiments) {
    for (const auto& [system, name] : variants) {
      const Scores* s = Find(experiment, system);
      if (s == nullptr) continue;
      table.Add({DatasetName(experiment.directory), name, Decimals(s->panoptics.all.pq, 3),
                 Decimals(s->panoptics.all.sq, 3), Decimals(s->panoptics.all.rq, 3), Decimals(s->semantics.mean_iou, 3),
                 Decimals(s->semantics.accuracy, 3),
                 s->precisions.empty() ? "-" : Decimals(s->precisions.back().mean, 3),
                 Decimals(PerFrame_ms(*s, s->times.integrate_s), 1), Decimals(PerFrame_ms(*s, s->times.refine_s), 1),
                 Decimals(s->times.finish_s, 2)});
    }
  }
  return table.Text();
}

std::string PaperText(const std::vector<Experiment>& experiments, const std::vector<RetrievalTimes>& retrievals) {
  std::string text =
      "Numbers in brackets are the paper's (Hu et al., IROS 2024), measured on other frames with another network: "
      "they\n"
      "show which method is ahead, not by how much. Its Table I has PQ and SQ exchanged (as printed PQ is above SQ "
      "and\n"
      "RQ, which cannot be); here they are exchanged back.\n";
  if (!experiments.empty()) {
    text += "\n### Table I: labels\n\n" + LabelTable(experiments);
    text += "\n\\* without instances: of each class, all is one segment.\n";
    text += "\n### Table II: semantic labels against Kimera\n\n" + KimeraTable(experiments);
    text += "\n### Table III: geometry\n\n" + GeometryTable(experiments);
  }
  if (!retrievals.empty()) {
    text += "\n### Table IV: retrieving one object\n\n" + RetrievalTable(retrievals);
    text += "\nSynthetic maps of the paper's sizes, one thread, median of " + std::to_string(kRetrievalRuns) +
            " runs, " + ProcessorName() + ".\n";
  }
  if (!experiments.empty()) {
    text += "\n### What each part of the refinement brings\n\n" + AblationTable(experiments);
    text +=
        "\nWithout refinement a place can be held by several submaps, and all their surfaces count, as in the paper. "
        "Times\n"
        "are wall time; refinement while mapping runs on a thread of its own.\n";
    text += "\n### How it was measured\n";
    for (const Experiment& experiment : experiments) text.append("\n").append(ProtocolText(experiment));
  }
  return text;
}

}  // namespace dhpmap::evaluator
