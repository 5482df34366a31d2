// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/experiment_json.h"

#include <nlohmann/json.hpp>

namespace dhpmap::evaluator {
namespace {

using nlohmann::json;

json JsonOf(const Protocol& p) {
  return {{"sample_spacing_m", p.spacing_m},
          {"label_match_distance_m", p.d_match_m},
          {"min_segment_samples", p.min_elements},
          {"f_score_threshold_m", p.geometry.threshold_m},
          {"accuracy_truncation_m", p.geometry.accuracy_truncation_m},
          {"completion_truncation_m", p.geometry.completion_truncation_m}};
}

json JsonOf(const ClassMap& classes) {
  json list = json::array();
  for (const EvaluatedClass& c : classes.classes()) {
    list.push_back(
        {{"name", c.name}, {"is_thing", c.is_thing}, {"truth_ids", c.truth_ids}, {"predicted_ids", c.predicted_ids}});
  }
  return list;
}

json JsonOf(const PanopticMean& mean) {
  return {{"pq", mean.pq}, {"sq", mean.sq}, {"rq", mean.rq}, {"num_classes", mean.num_classes}};
}

std::string IouKey(double iou) { return "ap_" + std::to_string(static_cast<int>(100 * iou + 0.5)); }

json ClassesOf(const Scores& scores, const ClassMap& classes) {
  json list = json::array();
  for (std::size_t c = 0; c < scores.semantics.classes.size(); ++c) {
    const ClassCounts& counts = scores.semantics.classes[c];
    if (counts.num_truth == 0 && counts.num_predicted == 0) continue;
    const ClassPanoptic& p = scores.panoptics.classes[c];
    json row{{"name", classes.classes()[c].name},
             {"is_thing", classes.classes()[c].is_thing},
             {"num_truth_samples", counts.num_truth},
             {"num_predicted_samples", counts.num_predicted},
             {"num_right_samples", counts.num_right},
             {"iou", counts.iou()},
             {"is_present", p.is_present},
             {"pq", p.pq()},
             {"sq", p.sq()},
             {"rq", p.rq()},
             {"num_matched", p.num_matched},
             {"num_false", p.num_false},
             {"num_missed", p.num_missed}};
    for (const PrecisionAt& at : scores.precisions) {
      if (at.classes[c]) row[IouKey(at.iou)] = *at.classes[c];
    }
    list.push_back(std::move(row));
  }
  return list;
}

json JsonOf(const Scores& s, const ClassMap& classes) {
  json out{{"system", s.system},
           {"has_instances", s.has_instances},
           {"panoptic",
            {{"all", JsonOf(s.panoptics.all)},
             {"things", JsonOf(s.panoptics.things)},
             {"stuff", JsonOf(s.panoptics.stuff)}}},
           {"semantic",
            {{"mean_iou", s.semantics.mean_iou},
             {"accuracy", s.semantics.accuracy},
             {"num_samples", s.semantics.num_elements},
             {"num_answered", s.semantics.num_answered}}},
           {"with_false_surface",
            {{"num_false", s.with_false.num_false}, {"pq", s.with_false.pq}, {"mean_iou", s.with_false.mean_iou}}},
           {"geometry",
            {{"accuracy_m", s.geometry.accuracy_m},
             {"completion_m", s.geometry.completion_m},
             {"chamfer_l1_m", s.geometry.chamfer_l1_m()},
             {"precision", s.geometry.precision},
             {"recall", s.geometry.recall},
             {"covered", s.geometry.covered},
             {"f_score", s.geometry.f_score()}}},
           {"times",
            {{"num_frames", s.times.num_frames},
             {"integrate_s", s.times.integrate_s},
             {"refine_s", s.times.refine_s},
             {"finish_s", s.times.finish_s}}},
           {"classes", ClassesOf(s, classes)}};
  json instance = json::object();
  for (const PrecisionAt& at : s.precisions) instance[std::string("m").append(IouKey(at.iou))] = at.mean;
  if (!s.precisions.empty()) out["instance"] = std::move(instance);
  return out;
}

}  // namespace

json ToJson(const Experiment& experiment) {
  json config = json::object();
  for (const auto& [key, value] : ConfigToText(experiment.config)) config[key] = value;
  const auto list = [&experiment](const std::vector<Scores>& all) {
    json systems = json::array();
    for (const Scores& scores : all) systems.push_back(JsonOf(scores, experiment.classes));
    return systems;
  };
  json asked = list(experiment.asked);
  for (json& system : asked) {
    for (const char* of_surfaces : {"geometry", "with_false_surface"}) system.erase(of_surfaces);
  }
  return {{"data_set", experiment.directory},
          {"preset", experiment.preset},
          {"labels", experiment.labels},
          {"num_frames", experiment.num_frames},
          {"num_skipped_frames", experiment.num_skipped},
          {"config", std::move(config)},
          {"protocol", JsonOf(experiment.protocol)},
          {"class_map", JsonOf(experiment.classes)},
          {"num_truth_samples", experiment.num_truth_samples},
          {"systems", list(experiment.systems)},
          {"points_protocol", JsonOf(experiment.points_protocol)},
          {"num_truth_points", experiment.num_truth_points},
          {"systems_on_points", list(experiment.on_points)},
          {"systems_asked", std::move(asked)}};
}

}  // namespace dhpmap::evaluator
