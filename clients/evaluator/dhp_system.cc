// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/dhp_system.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "clients/evaluator/map_surface.h"
#include "mapping/pipeline/map_builder.h"
#include "mapping/query/point_lookup.h"

namespace dhpmap::evaluator {
namespace {

MapInfo InfoOf(const SystemSetup& setup) {
  MapInfo info;
  info.name = "evaluation";
  info.config = setup.config;
  info.label_set = setup.label_set;
  return info;
}

class DhpSystem : public MappingSystem {
 public:
  DhpSystem(std::string name, const SystemSetup& setup, SurfaceKind surface)
      : name_(std::move(name)), builder_(InfoOf(setup), setup.num_threads), surface_(surface) {}

  std::string name() const override { return name_; }
  bool has_instances() const override { return true; }

  Status Integrate(const PanopticFrame& frame) override {
    DHPMAP_ASSIGN_OR_RETURN(const FrameReport report, builder_.Integrate(frame));
    times_.num_frames += 1;
    times_.integrate_s += report.total_s() - report.refine_s;
    return Status::Ok();
  }

  void Finish() override {
    const auto start = std::chrono::steady_clock::now();
    builder_.Finish();
    times_.finish_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const RefinementReport& total = builder_.refinement_total();
    times_.refine_s = total.management_s + total.crf_s;
  }

  LabelledSurface Surface() const override { return SurfaceOf(builder_.map(), surface_); }
  std::optional<PointLabels> LabelsAt(std::span<const Eigen::Vector3f> points_m) const override {
    const Map& map = builder_.map();
    const PointLookup lookup(std::make_shared<const MapSnapshot>(map.info(), map.submaps()));
    const double truncation_m = map.info().config.truncation_m;
    PointLabels labels;
    labels.classes.reserve(points_m.size());
    labels.instances.reserve(points_m.size());
    for (const Eigen::Vector3f& p_m : points_m) {
      const PointInfo info = lookup.At(p_m.cast<double>());
      const bool is_near = info.is_observed && std::abs(info.distance_m) < truncation_m;
      const bool is_known = is_near && info.panoptic != Panoptic::kUnknown;
      labels.classes.push_back(is_known ? info.class_id.value : std::uint16_t{0});
      labels.instances.push_back(is_known ? info.submap.value : 0);
    }
    return labels;
  }
  SystemTimes times() const override { return times_; }

 private:
  std::string name_;
  MapBuilder builder_;
  SurfaceKind surface_;
  SystemTimes times_;
};

}  // namespace

std::unique_ptr<MappingSystem> MakeDhp(std::string name, const SystemSetup& setup) {
  const RefinementConfig& refinement = setup.config.refinement;
  const bool is_exclusive = refinement.management || refinement.crf;
  return std::make_unique<DhpSystem>(std::move(name), setup,
                                     is_exclusive ? SurfaceKind::kOneField : SurfaceKind::kEachSubmap);
}

std::unique_ptr<MappingSystem> MakeDhpOfOneField(std::string name, const SystemSetup& setup) {
  return std::make_unique<DhpSystem>(std::move(name), setup, SurfaceKind::kOneField);
}

std::unique_ptr<MappingSystem> MakeTruthMap(SystemSetup setup) {
  MapConfig& config = setup.config;
  config.refinement.management = false;
  config.refinement.crf = false;
  config.refinement.drop_voxel_labels = false;
  config.activity.required_reobservations = 0;
  config.tracking.min_points_stuff = 1;
  config.tracking.min_points_small = 1;
  config.tracking.min_points_medium = 1;
  config.tracking.min_points_large = 1;
  return std::make_unique<DhpSystem>("ground truth", setup, SurfaceKind::kOneField);
}

}  // namespace dhpmap::evaluator
