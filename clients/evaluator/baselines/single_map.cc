// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/single_map.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "clients/evaluator/baselines/baselines.h"
#include "clients/evaluator/baselines/connected_objects.h"
#include "clients/evaluator/baselines/stored_distance.h"
#include "mapping/fusion/integrator.h"

namespace dhpmap::evaluator {
namespace {

SubmapInfo WholeWorld(const MapConfig& config) {
  SubmapInfo info;
  info.id = kUnknownSubmap;  // so that its surface has no instances
  info.voxel_size_m = config.voxel_size_m;
  info.truncation_m = config.truncation_m;
  return info;
}

}  // namespace

SingleMap::SingleMap(std::string name, const SystemSetup& setup, std::unique_ptr<SemanticLayer> labels)
    : name_(std::move(name)),
      setup_(setup),
      pool_(setup.num_threads),
      rays_(setup.config.integration, pool_),
      map_(WholeWorld(setup.config), 1),
      labels_(std::move(labels)) {}

Status SingleMap::Integrate(const PanopticFrame& frame) {
  DHPMAP_RETURN_IF_ERROR(ValidateFrame(frame, *setup_.label_set));
  const auto start = std::chrono::steady_clock::now();
  const MapConfig& config = setup_.config;
  DHPMAP_RETURN_IF_ERROR(rays_.Assign(frame, config.voxel_size_m));
  const RayOrigin origin(frame.T_map_sensor.translation(), config.voxel_size_m);
  // The two layers are independent: one thread each.
  pool_.ParallelFor(2, [&](std::size_t task) {
    if (task == 1) {
      ObserveLabels(rays_, origin, config, *labels_);
    } else if (rays_.rays() != nullptr) {
      Fuse(*rays_.rays(), origin);
    }
  });
  times_.num_frames += 1;
  times_.integrate_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return Status::Ok();
}

void SingleMap::Fuse(const SegmentBundles& rays, const RayOrigin& origin) {
  IntegrateSegment(rays, origin, {}, setup_.config.integration, map_);
}

ClassId SingleMap::LabelNear(const Eigen::Vector3f& vertex_m) const {
  const double voxel_size_m = setup_.config.voxel_size_m;
  const Eigen::Vector3d p_m = vertex_m.cast<double>();
  const VoxelIndex nearest = VoxelAt(p_m, voxel_size_m);
  if (const auto label = labels_->LabelAt(nearest)) return *label;
  // A vertex lies between two voxel centres: the other one is in the direction from the nearest centre to the vertex.
  const Eigen::Vector3d off_m = p_m - VoxelCentre(nearest, voxel_size_m);
  Eigen::Index axis = 0;
  off_m.cwiseAbs().maxCoeff(&axis);
  VoxelIndex other = nearest;
  (axis == 0 ? other.x : axis == 1 ? other.y : other.z) += off_m[axis] > 0 ? 1 : -1;
  return labels_->LabelAt(other).value_or(ClassId(0));
}

LabelledSurface SingleMap::Surface() const {
  LabelledSurface surface;
  surface.mesh = ExtractMesh(map_, *setup_.label_set, MeshColoring::kSensor);
  for (std::size_t i = 0; i < surface.mesh.vertices_m.size(); ++i) {
    surface.mesh.classes[i] = LabelNear(surface.mesh.vertices_m[i]).value;
  }
  return surface;
}

std::optional<PointLabels> SingleMap::LabelsAt(std::span<const Eigen::Vector3f> points_m) const {
  const MapConfig& config = setup_.config;
  PointLabels labels;
  labels.instances.assign(points_m.size(), 0);
  labels.classes.reserve(points_m.size());
  for (const Eigen::Vector3f& p_m : points_m) {
    const VoxelIndex voxel = VoxelAt(p_m.cast<double>(), config.voxel_size_m);
    const std::optional<float> distance_m = DistanceAt(map_, voxel);
    const bool is_near = distance_m && std::abs(static_cast<double>(*distance_m)) < config.truncation_m;
    const auto label = is_near ? labels_->LabelAt(voxel) : std::nullopt;
    labels.classes.push_back(label.value_or(ClassId(0)).value);
  }
  return labels;
}

// Without Kimera's carving of free space, which does it harm: with it, the F-score fell by 4 points on both sequences
// of kitti and by half a point on house, and mIoU on kitti by 0.01.
std::unique_ptr<MappingSystem> MakeKimera(const SystemSetup& setup) {
  constexpr double kMeasurementProbability = 0.8;  // of its launch files
  return std::make_unique<SingleMap>("kimera", setup, std::make_unique<BayesianLayer>(kMeasurementProbability));
}

std::unique_ptr<MappingSystem> MakeVotes(const SystemSetup& setup) {
  return std::make_unique<SingleMap>("votes", setup, std::make_unique<VoteLayer>());
}

std::unique_ptr<MappingSystem> MakeVotesWithObjects(const SystemSetup& setup) {
  return WithConnectedObjects("votes_objects", setup, MakeVotes(setup));
}

}  // namespace dhpmap::evaluator
