// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "mapping/mesh/map_mesh.h"
#include "mapping/query/distance_query.h"
#include "mapping/query/point_lookup.h"
#include "tests/bench/bench.h"
#include "tests/bench/recording.h"
#include "tests/bench/surface_truth.h"

namespace dhpmap::bench {
namespace {

constexpr double kMost_m = 1.0;  // what is farther counts as that far

/// Of points around surfaces: the distance that a query told less that to the mesh, in voxels.
struct Differences {
  std::vector<double> vox;
  std::size_t num_nearest_free = 0;            ///< by QueryPoints of the same state
  std::size_t num_nearest_looked_through = 0;  ///< by depth images, and never measured

  void Print(const char* of) const {
    std::vector<double> sizes;
    std::size_t num_shorter = 0;
    for (const double d : vox) {
      sizes.push_back(std::abs(d));
      num_shorter += d < -1 ? 1 : 0;
    }
    std::sort(sizes.begin(), sizes.end());
    const auto percent = [&](std::size_t n) {
      return 100 * static_cast<double>(n) / static_cast<double>(sizes.size());
    };
    const auto beyond = [&](double d) {
      return static_cast<std::size_t>(sizes.end() - std::upper_bound(sizes.begin(), sizes.end(), d));
    };
    if (sizes.empty()) return;
    std::printf(
        "%s: %zu points, %.3f %% differ by > 1 voxel (%.3f %% are shorter), %.3f %% by > 2; p99 %.2f voxels, worst "
        "%.2f; "
        "nearest points free %.3f %%, looked through and never measured %.3f %%\n",
        of, sizes.size(), percent(beyond(1)), percent(num_shorter), percent(beyond(2)),
        sizes[static_cast<std::size_t>(0.99 * static_cast<double>(sizes.size() - 1))], sizes.back(),
        percent(num_nearest_free), percent(num_nearest_looked_through));
  }
};

/// What a state answers, and what its mesh says.
class SurfaceJudge {
 public:
  SurfaceJudge(const Recording& recording, std::shared_ptr<const MapSnapshot> asked, const QueryScope& scope,
               const MapSnapshot& true_state)
      : recording_(recording),
        cache_(std::size_t{1} << 30),
        lookup_(asked),
        query_(cache_.Of(asked), {.max_distance_m = kMost_m, .unknown_is_free = true, .scope = scope}),
        mesh_([&] {
          ThreadPool pool(0);
          return ExtractMapMesh(true_state, MeshColoring::kInstance, pool);
        }()),
        truth_(mesh_) {}

  [[nodiscard]] const MeshTruth& truth() const { return truth_; }
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

  void Ask(const Eigen::Vector3d& p, Differences& all) const {
    const SurfaceDistance answer = query_.At(p);
    const double told_m = answer.submap == nullptr ? kMost_m : std::abs(answer.distance_m);
    all.vox.push_back((told_m - truth_.Distance(p, kMost_m)) / recording_.voxel_m());
    if (answer.submap == nullptr) return;
    all.num_nearest_free += lookup_.At(answer.nearest_m).is_free ? 1 : 0;
    all.num_nearest_looked_through += IsLookedThrough(answer.nearest_m) ? 1 : 0;
  }
  [[nodiscard]] bool IsLookedThrough(const Eigen::Vector3d& p) const {
    const DepthView view = View(p);
    return view.is_looked_through && !view.is_measured;
  }
  [[nodiscard]] DepthView View(const Eigen::Vector3d& p) const {
    return LookAt(recording_.loaded.frames, p, recording_.voxel_m(), recording_.info.config.integration.max_range_m);
  }

 private:
  const Recording& recording_;
  SurfaceCache cache_;
  PointLookup lookup_;
  DistanceQuery query_;
  Mesh mesh_;
  MeshTruth truth_;
};

Eigen::Vector3d Around(const Eigen::Vector3d& centre, double reach_m, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  for (;;) {
    const Eigen::Vector3d offset{unit(random), unit(random), unit(random)};
    if (offset.squaredNorm() <= 1) return centre + reach_m * offset;
  }
}

void JudgeWhole(const Recording& recording, const SurfaceCheckOptions& options, std::mt19937& random) {
  const auto state = recording.builder->map().Publish(0);
  const SurfaceJudge judge(recording, state, {}, *state);
  Differences all;
  for (std::size_t i = 0; i < options.num_points; ++i) {
    judge.Ask(Around(judge.truth().Sample(random), options.reach_m, random), all);
  }
  all.Print("as it is");
  std::size_t num_measured = 0, num_looked_through = 0;
  for (std::size_t i = 0; i < options.num_points; ++i) {
    const DepthView view = judge.View(judge.truth().Sample(random));
    num_measured += view.is_measured ? 1 : 0;
    num_looked_through += view.is_looked_through && !view.is_measured ? 1 : 0;
  }
  const double share = 100 / static_cast<double>(options.num_points);
  std::printf("mesh: %zu triangles; of its samples %.2f %% were measured, %.2f %% looked through and never measured\n",
              judge.mesh().triangles.size(), share * static_cast<double>(num_measured),
              share * static_cast<double>(num_looked_through));
  std::size_t num_covered = 0;
  const auto measured = MeasuredPoints(recording.loaded.frames, options.num_points,
                                       0.8 * recording.info.config.integration.max_range_m, random);
  for (const Eigen::Vector3d& p : measured) {
    num_covered += judge.truth().Distance(p, kMost_m) <= recording.voxel_m() ? 1 : 0;
  }
  std::printf("of measured points %.3f %% have the mesh within a voxel\n",
              100 * static_cast<double>(num_covered) / static_cast<double>(std::max<std::size_t>(1, measured.size())));
}

/// Those with the most voxels.
std::vector<SubmapId> LargestThings(const MapSnapshot& state, std::size_t most) {
  std::vector<std::pair<std::size_t, SubmapId>> things;
  for (const auto& submap : state.submaps()) {
    if (submap->info().panoptic != Panoptic::kThing || submap->IsAbsent()) continue;
    things.emplace_back(submap->blocks().tiles().size(), submap->id());
  }
  std::sort(things.begin(), things.end(), std::greater<>());
  std::vector<SubmapId> largest;
  for (std::size_t i = 0; i < std::min(most, things.size()); ++i) largest.push_back(things[i].second);
  return largest;
}

/// Things left out of questions, and things moved, each alone: around where they were, and where they went.
void JudgeChanged(const Recording& recording, const SurfaceCheckOptions& options, std::mt19937& random) {
  const auto state = recording.builder->map().Publish(0);
  Differences excluded, moved;
  ThreadPool pool(0);
  const std::vector<SubmapId> things = LargestThings(*state, options.num_things);
  for (const SubmapId id : things) {
    Map without = recording.builder->map().Fork(), elsewhere = recording.builder->map().Fork();
    without.Remove(id);
    Submap& submap = *elsewhere.FindMutable(id);
    submap.mutable_info().T_map_submap.pretranslate(Eigen::Vector3d(0.31, 0.17, 0.05));
    submap.mutable_info().is_placed = true;
    const auto left = without.Publish(0), there = elsewhere.Publish(0);
    const Mesh own = ExtractMesh(*state->Find(id), *recording.info.label_set, MeshColoring::kInstance);
    const MeshTruth place(own);
    if (place.empty()) continue;
    const SurfaceJudge of_excluded(recording, state, {.excluded_submaps = {id}}, *left),
        of_moved(recording, there, {}, *there);
    for (std::size_t i = 0; i < options.num_points / things.size(); ++i) {
      const Eigen::Vector3d p = Around(place.Sample(random), options.reach_m, random);
      of_excluded.Ask(p, excluded);
      of_moved.Ask(p, moved);
    }
  }
  excluded.Print("with a thing excluded");
  moved.Print("with a thing moved");
}

}  // namespace

Status RunSurfaceCheck(const SurfaceCheckOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const Recording recording, MapRecording(options.directory, options.num_frames));
  std::mt19937 random(options.seed);
  JudgeWhole(recording, options, random);
  JudgeChanged(recording, options, random);
  return Status::Ok();
}

}  // namespace dhpmap::bench
