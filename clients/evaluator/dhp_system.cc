// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/dhp_system.h"

#include <chrono>
#include <utility>

#include "mapping/pipeline/map_builder.h"

namespace dhpmap::evaluator {
namespace {

double Since_s(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

MapInfo InfoOf(const SystemSetup& setup) {
  MapInfo info;
  info.name = "evaluation";
  info.config = setup.config;
  info.label_set = setup.label_set;
  return info;
}

class DhpSystem : public MappingSystem {
 public:
  DhpSystem(std::string name, const SystemSetup& setup)
      : name_(std::move(name)), builder_(InfoOf(setup), setup.num_threads) {}

  std::string name() const override { return name_; }
  bool has_instances() const override { return true; }

  Status Integrate(const PanopticFrame& frame) override {
    const auto start = std::chrono::steady_clock::now();
    DHPMAP_ASSIGN_OR_RETURN(const FrameReport report, builder_.Integrate(frame));
    times_.num_frames += 1;
    times_.integrate_s += report.total_s();
    times_.refine_s += std::max(0.0, Since_s(start) - report.total_s());
    return Status::Ok();
  }

  void Finish() override {
    const auto start = std::chrono::steady_clock::now();
    builder_.Finish();
    times_.refine_s += Since_s(start);
  }

  LabelledSurface Surface() const override { return SurfaceOf(builder_.map()); }
  SystemTimes times() const override { return times_; }

 private:
  std::string name_;
  MapBuilder builder_;
  SystemTimes times_;
};

}  // namespace

std::unique_ptr<MappingSystem> MakeDhp(std::string name, const SystemSetup& setup) {
  return std::make_unique<DhpSystem>(std::move(name), setup);
}

LabelledSurface SurfaceOf(const Map& map) {
  LabelledSurface surface;
  for (const auto& submap : map.submaps()) {
    Mesh mesh = ExtractMesh(*submap, *map.info().label_set, MeshColoring::kSensor);
    if (submap->info().panoptic == Panoptic::kUnknown) {
      mesh.classes.assign(mesh.classes.size(), 0);
      mesh.instances.assign(mesh.instances.size(), 0);
    } else {
      surface.instance_scores[submap->id().value] =
          submap->info().ClassConfidence() * submap->info().instance_confidence;
    }
    AppendMesh(mesh, surface.mesh);
  }
  return surface;
}

}  // namespace dhpmap::evaluator
