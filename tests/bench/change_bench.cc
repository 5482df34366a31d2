// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "clients/datasets/open_dataset.h"
#include "mapping/pipeline/map_builder.h"
#include "mapping/query/distance_query.h"
#include "mapping/space/presence.h"
#include "tests/bench/bench.h"
#include "tests/bench/frames.h"
#include "tests/bench/gone_causes.h"

namespace dhpmap::bench {
namespace {

/// changes.json of dhpmap-simulate --change.
struct Changes {
  std::size_t first_frame_after = 0;
  std::map<std::uint32_t, bool> is_gone;  ///< by instance; the others of them were moved
};

Result<Changes> ReadChanges(const std::string& directory) {
  std::ifstream file(directory + "/changes.json");
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (json.is_discarded()) return NotFound(directory + " has no changes.json: record it with dhpmap-simulate --change");
  Changes changes{.first_frame_after = json.value("first_frame_after", std::size_t{0}), .is_gone = {}};
  for (const auto& change : json.value("changes", nlohmann::json::array())) {
    changes.is_gone[change.value("id", 0u)] = change.value("change", "") == "gone";
  }
  return changes;
}

/// Measured points, one a cell.
class PointSet {
 public:
  explicit PointSet(double cell_m) : cell_m_(cell_m) {}
  void Add(const Eigen::Vector3d& p, std::uint32_t instance) {
    points_.try_emplace(VoxelAt(p, cell_m_), GonePoint{p, instance});
  }
  /// Within two cells along each axis.
  [[nodiscard]] bool HasNear(const Eigen::Vector3d& p) const {
    const VoxelIndex v = VoxelAt(p, cell_m_);
    for (int i = 0; i < 125; ++i) {
      if (points_.contains({v.x + i % 5 - 2, v.y + i / 5 % 5 - 2, v.z + i / 25 - 2})) return true;
    }
    return false;
  }
  [[nodiscard]] std::vector<Eigen::Vector3d> List() const {
    std::vector<Eigen::Vector3d> list;
    for (const auto& [voxel, point] : points_) list.push_back(point.p_map_m);
    return list;
  }
  /// In the same order.
  [[nodiscard]] std::vector<GonePoint> ListWithInstances() const {
    std::vector<GonePoint> list;
    for (const auto& [voxel, point] : points_) list.push_back(point);
    return list;
  }

 private:
  struct Hash {
    std::size_t operator()(VoxelIndex v) const { return BlockIndexHash()({v.x, v.y, v.z}); }
  };
  double cell_m_;
  std::unordered_map<VoxelIndex, GonePoint, Hash> points_;
};

/// What the frames measured of what is gone, of what was moved, at its new place, and of all else in the second walk.
struct Measured {
  PointSet gone, moved, still;
  explicit Measured(double cell_m) : gone(cell_m), moved(cell_m), still(cell_m) {}

  void Add(const PanopticFrame& frame, bool is_after, const Changes& changes) {
    constexpr int kStep_px = 4;
    constexpr double kMost_m = 3.5;
    const DepthCameraData& data = *frame.camera;
    const PinholeCamera& camera = data.camera;
    for (int v = 0; v < camera.height_px; v += kStep_px) {
      for (int u = 0; u < camera.width_px; u += kStep_px) {
        const auto pixel = static_cast<std::size_t>(v * camera.width_px + u);
        const double depth_m = data.depth_m[pixel];
        if (data.segments[pixel] == 0 || !(depth_m > 0.2 && depth_m < kMost_m)) continue;
        const Eigen::Vector3d p =
            frame.T_map_sensor * Eigen::Vector3d((u - camera.cx_px) / camera.fx_px * depth_m,
                                                 (v - camera.cy_px) / camera.fy_px * depth_m, depth_m);
        const auto change = changes.is_gone.find(data.segments[pixel]);
        if (change == changes.is_gone.end()) {
          if (is_after) still.Add(p, data.segments[pixel]);
        } else if (is_after) {
          moved.Add(p, data.segments[pixel]);
        } else {
          gone.Add(p, data.segments[pixel]);  // from where it was moved away, too
        }
      }
    }
  }
};

std::vector<SurfaceDistance> NearestSurfaces(const std::shared_ptr<const MapSnapshot>& map,
                                             const std::vector<Eigen::Vector3d>& points) {
  SurfaceCache cache(std::size_t{1} << 30);
  std::vector<SurfaceDistance> answers(points.size());
  DistanceQuery(cache.Of(map), {.max_distance_m = 0.5}).At(points, answers);
  return answers;
}

bool HasSurface(const SurfaceDistance& answer, const MapSnapshot& map) {
  return answer.submap != nullptr && std::abs(answer.distance_m) <= map.info().config.voxel_size_m;
}

std::vector<bool> HaveSurface(const std::shared_ptr<const MapSnapshot>& map,
                              const std::vector<Eigen::Vector3d>& points) {
  std::vector<bool> have;
  for (const SurfaceDistance& answer : NearestSurfaces(map, points)) have.push_back(HasSurface(answer, *map));
  return have;
}

/// Why points of what is gone have a surface.
void PrintCauses(const std::shared_ptr<const MapSnapshot>& after, const SecondWalk& walk,
                 const std::vector<GonePoint>& gone) {
  std::vector<Eigen::Vector3d> points;
  for (const GonePoint& point : gone) points.push_back(point.p_map_m);
  const std::vector<SurfaceDistance> answers = NearestSurfaces(after, points);
  std::vector<GonePoint> left;
  std::vector<SurfaceDistance> nearest;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (!HasSurface(answers[i], *after)) continue;
    left.push_back(gone[i]);
    nearest.push_back(answers[i]);
  }
  PrintGoneCauses(*after, walk, left, nearest, gone.size());
}

void Print(const char* what, const std::vector<bool>& has) {
  const auto count = std::count(has.begin(), has.end(), true);
  std::printf("  %-44s %7.2f %% of %zu points\n", what,
              100.0 * static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, has.size())),
              has.size());
}

}  // namespace

Status RunChangeBench(const ChangeBenchOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const Changes changes, ReadChanges(options.directory));
  DHPMAP_ASSIGN_OR_RETURN(const LabelSource source, ParseLabelSource(options.labels));
  DHPMAP_ASSIGN_OR_RETURN(const auto dataset, OpenDataset(options.directory, kAnyFormat, source));
  DHPMAP_ASSIGN_OR_RETURN(const auto truth, OpenDataset(options.directory, kAnyFormat, LabelSource::kGroundTruth));
  MapInfo info;
  info.name = "bench";
  DHPMAP_RETURN_IF_ERROR(ApplyPreset(dataset->preset(), info.config));
  info.config.space.gone = options.gone;
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(dataset->label_classes()));
  info.label_set = std::make_shared<LabelSet>(std::move(label_set));

  MapBuilder builder(info, 0);
  Measured measured(0.5 * info.config.voxel_size_m);
  SecondWalk walk;
  std::shared_ptr<const MapSnapshot> between;
  for (std::size_t i = 0; i < dataset->num_frames(); ++i) {
    DHPMAP_ASSIGN_OR_RETURN(const DatasetFrame read, dataset->Read(i));
    DHPMAP_ASSIGN_OR_RETURN(PanopticFrame frame,
                            DecodeFrame(read, dataset->has_persistent_ids() && !options.framewise));
    DHPMAP_ASSIGN_OR_RETURN(const DatasetFrame read_truth, truth->Read(i));
    DHPMAP_ASSIGN_OR_RETURN(const PanopticFrame true_frame, DecodeFrame(read_truth, true));
    if (i == changes.first_frame_after) between = builder.map().Freeze();
    measured.Add(true_frame, i >= changes.first_frame_after, changes);
    if (i >= changes.first_frame_after) walk.Add(true_frame);
    DHPMAP_RETURN_IF_ERROR(builder.Integrate(frame).status());
  }
  builder.Finish();
  const auto after = builder.map().Publish(0);
  if (between == nullptr) return InvalidArgument("the recording has one walk only");

  // Of what is gone, what had a surface, and where there is nothing else now: else that has one within a voxel.
  std::vector<Eigen::Vector3d> gone;
  std::vector<GonePoint> gone_points;
  const std::vector<GonePoint> all_gone = measured.gone.ListWithInstances();
  const std::vector<Eigen::Vector3d> once = measured.gone.List();
  const std::vector<bool> had = HaveSurface(between, once);
  for (std::size_t i = 0; i < once.size(); ++i) {
    if (had[i] && !measured.still.HasNear(once[i]) && !measured.moved.HasNear(once[i])) {
      gone.push_back(once[i]);
      gone_points.push_back(all_gone[i]);
    }
  }
  std::vector<Eigen::Vector3d> still;
  const std::vector<Eigen::Vector3d> all_still = measured.still.List();
  const std::vector<bool> had_still = HaveSurface(between, all_still);
  for (std::size_t i = 0; i < all_still.size(); ++i) {
    if (had_still[i]) still.push_back(all_still[i]);
  }
  std::printf("%s labels%s, gone %s: points with a surface within a voxel, after both walks\n", options.labels.c_str(),
              options.framewise ? " without persistent ids" : "", options.gone ? "on" : "off");
  Print("of what is gone, or was moved away", HaveSurface(after, gone));
  PrintCauses(after, walk, gone_points);
  Print("of what was moved, at its new place", HaveSurface(after, measured.moved.List()));
  Print("of all else that had one before", HaveSurface(after, still));
  int num_absent = 0;
  SurfaceVoxels sum;
  for (const auto& submap : after->submaps()) {
    num_absent += submap->IsAbsent();
    const SurfaceVoxels voxels = CountSurfaceVoxels(*submap);
    sum.all += voxels.all;
    sum.contradicted += voxels.contradicted;
  }
  std::printf("  %d of %zu submaps absent, %lld of %lld surface voxels contradicted\n", num_absent,
              after->submaps().size(), static_cast<long long>(sum.contradicted), static_cast<long long>(sum.all));
  return Status::Ok();
}

}  // namespace dhpmap::bench
