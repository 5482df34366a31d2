// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "mapping/mesh/map_mesh.h"
#include "mapping/pipeline/map_builder.h"
#include "mapping/query/point_lookup.h"
#include "tests/bench/bench.h"
#include "tests/bench/frames.h"
#include "tests/bench/mesh_judge.h"

namespace dhpmap::bench {
namespace {

constexpr double kMinDepth_m = 0.3;
constexpr double kMaxDepth_m = 4.0;

/// Stored distance around a point of the submap: trilinear with its gradient where all 8 voxels are observed, else that
/// of the voxel which holds the point.
struct Sample {
  double distance_m = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  bool is_trilinear = false;
};

std::optional<Sample> SampleAt(const Submap& submap, const Eigen::Vector3d& p_submap) {
  const double size = submap.info().voxel_size_m;
  const auto stored = [&submap](VoxelIndex voxel) -> std::optional<double> {
    const BlockEntry* entry = submap.blocks().Find(BlockOf(voxel));
    if (entry == nullptr || !entry->tsdf->IsObserved(LinearIndex(voxel))) return std::nullopt;
    return entry->tsdf->distance_m[static_cast<std::size_t>(LinearIndex(voxel))];
  };
  const Eigen::Vector3d shifted = p_submap - Eigen::Vector3d::Constant(size / 2);
  const VoxelIndex low = VoxelAt(shifted, size);
  const Eigen::Vector3d f = shifted / size - Eigen::Vector3d(low.x, low.y, low.z);
  Sample sample{.is_trilinear = true};
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3i d(corner & 1, (corner >> 1) & 1, corner >> 2);
    const std::optional<double> value = stored({low.x + d.x(), low.y + d.y(), low.z + d.z()});
    if (!value) {
      const std::optional<double> nearest = stored(VoxelAt(p_submap, size));
      if (!nearest) return std::nullopt;
      return Sample{.distance_m = *nearest};
    }
    const Eigen::Array3d w = (d == 1).select(f.array(), 1 - f.array());
    const Eigen::Array3d sign = (d == 1).select(Eigen::Array3d::Ones(), -Eigen::Array3d::Ones());
    sample.distance_m += *value * w.prod();
    sample.gradient += *value * (sign * Eigen::Array3d(w.y() * w.z(), w.x() * w.z(), w.x() * w.y())).matrix() / size;
  }
  return sample;
}

/// First passage from outside to inside any submap's surface along a ray: range in m, or nothing up to max_m.
std::optional<double> FirstSurface(const MapSnapshot& map, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction, double max_m) {
  std::optional<double> first;
  for (const auto& submap : map.submaps()) {
    const BoundingSphere sphere = submap->BoundingSphereInMap();
    const double nearest_m = (sphere.center_m - origin).dot(direction);
    const double off_m = (sphere.center_m - origin - nearest_m * direction).norm();
    if (sphere.IsEmpty() || off_m > sphere.radius_m) continue;
    const double half_m = std::sqrt(sphere.radius_m * sphere.radius_m - off_m * off_m);
    const double step_m = submap->info().voxel_size_m / 4;
    const double end_m = std::min(nearest_m + half_m, first.value_or(max_m));
    std::optional<double> before;
    const double begin_m = std::max(0.05, nearest_m - half_m);
    for (int step = 0; begin_m + step * step_m < end_m; ++step) {
      const double t = begin_m + step * step_m;
      const std::optional<Sample> sample =
          SampleAt(*submap, submap->info().T_map_submap.inverse() * (origin + t * direction));
      if (sample && before && *before > 0 && sample->distance_m <= 0) {
        first = t - step_m * sample->distance_m / (sample->distance_m - *before);
        break;
      }
      before = sample ? std::optional(sample->distance_m) : std::nullopt;
    }
  }
  return first;
}

struct Errors {
  std::vector<double> surface_m;  ///< from the measured point to the zero surface: distance over gradient
  std::vector<double> along_ray_m;
  std::size_t num_rays = 0;
  std::size_t num_unmapped = 0;  ///< nothing fused there: no frame had seen it
  std::size_t num_through = 0;   ///< mapped there, yet the ray goes on for more than kThrough_m
  std::size_t num_early = 0;     ///< stopped more than kThrough_m before
};
constexpr double kThrough_m = 0.2;
constexpr double kLeastGradient = 0.3;  // averaging flattens the field where surfaces meet

void CheckFrame(const PanopticFrame& frame, int pixel_step, const MapSnapshot& map, const PointLookup& lookup,
                Errors& errors) {
  const PinholeCamera& camera = frame.camera->camera;
  const Eigen::Vector3d origin = frame.T_map_sensor.translation();
  for (int v = 0; v < camera.height_px; v += pixel_step) {
    for (int u = 0; u < camera.width_px; u += pixel_step) {
      const double depth =
          frame.camera->depth_m[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width_px) +
                                static_cast<std::size_t>(u)];
      if (!(depth >= kMinDepth_m && depth <= kMaxDepth_m)) continue;
      const Eigen::Vector3d p_sensor((u - camera.cx_px) / camera.fx_px * depth,
                                     (v - camera.cy_px) / camera.fy_px * depth, depth);
      const double range_m = p_sensor.norm();
      const Eigen::Vector3d direction = frame.T_map_sensor.linear() * p_sensor / range_m;
      ++errors.num_rays;
      const Eigen::Vector3d p_map = origin + range_m * direction;
      const PointInfo here = lookup.At(p_map);
      if (!here.is_observed) {
        ++errors.num_unmapped;
        continue;
      }
      const Submap& submap = *map.Find(here.submap);
      const std::optional<Sample> sample = SampleAt(submap, submap.info().T_map_submap.inverse() * p_map);
      if (sample && sample->is_trilinear) {
        errors.surface_m.push_back(std::abs(sample->distance_m) / std::max(kLeastGradient, sample->gradient.norm()));
      }
      const std::optional<double> hit_m = FirstSurface(map, origin, direction, range_m + 1.0);
      if (!hit_m || *hit_m > range_m + kThrough_m) {
        ++errors.num_through;
      } else if (*hit_m < range_m - kThrough_m) {
        ++errors.num_early;
      } else {
        errors.along_ray_m.push_back(std::abs(*hit_m - range_m));
      }
    }
  }
}

void Print(const char* what, const std::vector<double>& values, double scale, const char* unit, std::size_t num_asked) {
  const Summary summary = Summarize(values);
  double rms = 0;
  for (const double value : values) rms += value * value / static_cast<double>(values.size());
  rms = std::sqrt(rms);
  std::printf("%s: median %.2f %s, mean %.2f, rms %.2f, 95 %% below %.2f (%.2f %% of %zu)\n", what,
              scale * summary.median, unit, scale * summary.mean, scale * rms, scale * summary.p95,
              100.0 * static_cast<double>(values.size()) / static_cast<double>(num_asked), num_asked);
}

void PrintErrors(const Errors& errors) {
  const auto percent = [&](std::size_t n) {
    return 100.0 * static_cast<double>(n) / static_cast<double>(errors.num_rays);
  };
  std::printf("%zu rays of held-out frames, depth %g to %g m\n", errors.num_rays, kMinDepth_m, kMaxDepth_m);
  Print("measured point to surface", errors.surface_m, 1e3, "mm", errors.num_rays);
  Print("along the ray, measured to mapped", errors.along_ray_m, 1e3, "mm", errors.num_rays);
  std::printf(
      "not mapped by any fused frame %.2f %%, stopped over %g m early %.2f %%, went through a mapped surface %.2f %%\n",
      percent(errors.num_unmapped), kThrough_m, percent(errors.num_early), percent(errors.num_through));
}

/// What is in range of a scan, in the map.
void AddPoints(const PanopticFrame& frame, const IntegrationConfig& config, std::vector<Eigen::Vector3f>& points_m) {
  for (const Eigen::Vector3f& p_sensor : frame.lidar->points_m) {
    const double range_m = p_sensor.cast<double>().norm();
    if (range_m < config.min_range_m || range_m > config.max_range_m) continue;
    points_m.emplace_back((frame.T_map_sensor * p_sensor.cast<double>()).cast<float>());
  }
}

void JudgeMesh(const Mesh& mesh, const std::vector<Eigen::Vector3f>& points_m, double voxel_size_m) {
  if (!points_m.empty()) {
    const PointsToMesh measured = MeasurePoints(points_m, mesh, 2 * voxel_size_m);
    Print("sensor's points to the nearest triangle", measured.distances_m, 1e3, "mm", points_m.size());
    std::printf("without a surface within 2 voxels: %.2f %%\n",
                100.0 * static_cast<double>(measured.num_without) / static_cast<double>(points_m.size()));
  }
  // Wide enough to see a ripple, and to have a wall's plane in spite of it.
  const Roughness rough = MeasureRoughness(mesh, 12 * voxel_size_m, voxel_size_m / 4);
  std::printf("%zu triangles, %zu cubes of 12 voxels with something flat\n", mesh.triangles.size(), rough.num_cubes);
  Print("triangles to a flat place's plane", rough.angles_deg, 1, "degrees", mesh.triangles.size());
  Print("vertices off it", rough.off_plane_m, 1e3, "mm", 3 * mesh.triangles.size());
}

}  // namespace

Status RunGeometryCheck(const GeometryCheckOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const LoadedFrames loaded, LoadFrames(options.directory, LabelSource::kGroundTruth, 0));
  MapInfo info;
  info.name = "geometry";
  DHPMAP_RETURN_IF_ERROR(ApplyPreset(loaded.dataset->preset(), info.config));
  if (options.voxel_size_m > 0) info.config.voxel_size_m = options.voxel_size_m;
  if (options.truncation_m > 0) info.config.truncation_m = options.truncation_m;
  DHPMAP_RETURN_IF_ERROR(info.config.Validate());
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(loaded.dataset->label_classes()));
  info.label_set = std::make_shared<LabelSet>(std::move(label_set));

  MapBuilder builder(info, 0);
  const auto every = static_cast<std::size_t>(options.hold_out_every);
  const auto is_held_out = [every](std::size_t i) { return every != 0 && i % every == 0; };
  for (std::size_t i = 0; i < loaded.frames.size(); ++i) {
    if (!is_held_out(i)) DHPMAP_RETURN_IF_ERROR(builder.Integrate(loaded.frames[i]).status());
  }
  const auto map = builder.map().Publish(0);
  const PointLookup lookup(map);
  Errors errors;
  std::vector<Eigen::Vector3f> points_m;
  for (std::size_t i = 0; i < loaded.frames.size(); ++i) {
    const PanopticFrame& frame = loaded.frames[i];
    if (every != 0 && !is_held_out(i)) continue;
    if (frame.camera) CheckFrame(frame, options.pixel_step, *map, lookup, errors);
    if (frame.lidar) AddPoints(frame, info.config.integration, points_m);
  }
  if (errors.num_rays > 0) PrintErrors(errors);
  ThreadPool pool(0);
  JudgeMesh(ExtractMapMesh(*map, MeshColoring::kSensor, pool), points_m, info.config.voxel_size_m);
  return Status::Ok();
}

}  // namespace dhpmap::bench
