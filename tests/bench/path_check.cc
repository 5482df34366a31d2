// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "mapping/query/body_query.h"
#include "mapping/query/occupancy_slice.h"
#include "mapping/query/trajectory_query.h"
#include "tests/bench/bench.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/recording.h"

namespace dhpmap::bench {
namespace {

/// A slice, and where a ball may be by it.
struct Floor {
  SliceOptions slice;
  std::vector<std::int8_t> cells;
  std::vector<bool> may_go;  ///< by cell
  double made_s = 0;

  [[nodiscard]] bool MayGo(int x, int y) const {
    return x >= 0 && y >= 0 && x < slice.width && y < slice.height && may_go[At(x, y)];
  }
  [[nodiscard]] std::size_t At(int x, int y) const { return static_cast<std::size_t>(y * slice.width + x); }
  [[nodiscard]] Eigen::Vector3d Centre(int x, int y, double z_m) const {
    return {slice.min_m.x() + (x + 0.5) * slice.resolution_m, slice.min_m.y() + (y + 0.5) * slice.resolution_m, z_m};
  }
};

Floor SliceFloor(const std::shared_ptr<const MapSurfaces>& surfaces, const PathCheckOptions& options,
                 UnknownSpace unknown) {
  Floor floor;
  SliceOptions& slice = floor.slice;
  slice.min_z_m = options.min_z_m;
  slice.max_z_m = options.max_z_m;
  const double voxel_m = surfaces->state().info().config.voxel_size_m;
  slice.resolution_m = options.resolution_m > 0 ? options.resolution_m : voxel_m;
  slice.unknown = unknown == UnknownSpace::kFree ? kFreeCell : kOccupiedCell;
  const auto area = KnownArea(*surfaces, slice);
  if (!area) return floor;
  const Eigen::Array2d low = (area->min().array() / slice.resolution_m).floor();
  const Eigen::Array2d high = (area->max().array() / slice.resolution_m).ceil();
  slice.min_m = low * slice.resolution_m;
  slice.width = static_cast<int>(high.x() - low.x());
  slice.height = static_cast<int>(high.y() - low.y());
  floor.cells.resize(floor.At(0, slice.height));
  const double start_s = ThreadCpu_s();
  OccupancySlice made(surfaces, slice);
  for (int y = 0; y < slice.height; ++y) {
    made.Row(y, std::span(floor.cells).subspan(floor.At(0, y), static_cast<std::size_t>(slice.width)), {});
  }
  floor.made_s = ThreadCpu_s() - start_s;
  return floor;
}

/// Cells whose centre is farther than the radius and half a cell's diagonal from those of all that are not free.
void Inflate(Floor& floor, double radius_m) {
  const double reach = radius_m / floor.slice.resolution_m + std::sqrt(0.5);
  const int most = static_cast<int>(std::ceil(reach));
  floor.may_go.assign(floor.cells.size(), true);
  for (int y = 0; y < floor.slice.height; ++y) {
    for (int x = 0; x < floor.slice.width; ++x) {
      if (floor.cells[floor.At(x, y)] == kFreeCell) continue;
      for (int dy = -most; dy <= most; ++dy) {
        for (int dx = -most; dx <= most; ++dx) {
          if (dx * dx + dy * dy > reach * reach || !floor.MayGo(x + dx, y + dy)) continue;
          floor.may_go[floor.At(x + dx, y + dy)] = false;
        }
      }
    }
  }
}

class PathJudge {
 public:
  PathJudge(const std::shared_ptr<const MapSurfaces>& surfaces, const PathCheckOptions& options, UnknownSpace unknown)
      : options_(options),
        floor_(SliceFloor(surfaces, options, unknown)),
        motions_(TrajectoryQuery::Make(surfaces, {.bodies = {.unknown = unknown}, .attached = {}})),
        bodies_(surfaces, {.unknown = unknown}) {
    Inflate(floor_, options.radius_m);
  }

  void Judge(const char* policy) {
    std::size_t num_free = 0, num_cells = 0, num_steps = 0;
    std::vector<std::pair<double, Eigen::Vector3d>> bad_cells;
    std::size_t num_bad_steps = 0;
    const double low_m = options_.min_z_m + options_.radius_m, high_m = options_.max_z_m - options_.radius_m;
    for (int y = 0; y < floor_.slice.height; ++y) {
      for (int x = 0; x < floor_.slice.width; ++x) {
        num_free += floor_.cells[floor_.At(x, y)] == kFreeCell ? 1 : 0;
        if (!floor_.MayGo(x, y)) continue;
        ++num_cells;
        if (!Passes(floor_.Centre(x, y, low_m), floor_.Centre(x, y, high_m))) bad_cells.push_back(Deepest(x, y));
        constexpr int kSteps[][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
        for (const auto& step : kSteps) {
          if (!floor_.MayGo(x + step[0], y + step[1])) continue;
          ++num_steps;
          num_bad_steps += StepPasses(x, y, x + step[0], y + step[1]) ? 0 : 1;
        }
      }
    }
    std::sort(bad_cells.begin(), bad_cells.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::printf(
        "%s: %d x %d cells of %.3f m in %.0f ms, %zu free; a ball of %.2f m may be in %zu, in %zu of which it "
        "collides, and make %zu steps, of which in %zu",
        policy, floor_.slice.width, floor_.slice.height, floor_.slice.resolution_m, 1e3 * floor_.made_s, num_free,
        options_.radius_m, num_cells, bad_cells.size(), num_steps, num_bad_steps);
    if (!bad_cells.empty()) std::printf("; deepest %.1f cm", 100 * bad_cells.front().first);
    std::printf("\n");
    for (std::size_t i = 0; i < std::min<std::size_t>(bad_cells.size(), options_.num_listed); ++i) {
      const Eigen::Vector3d& p =
          bad_cells[i * bad_cells.size() / std::min(bad_cells.size(), options_.num_listed)].second;
      const BodyAnswer answer = bodies_.Check(Capsule{p, p, options_.radius_m});
      if (answer.contacts.empty()) continue;
      const BodyContact& contact = answer.contacts.front();
      std::printf("  at %.3f %.3f %.3f: %.3f deep at %.3f %.3f %.3f, %s %u\n", p.x(), p.y(), p.z(), contact.depth_m,
                  contact.point_m.x(), contact.point_m.y(), contact.point_m.z(),
                  contact.submap == nullptr ? "unseen" : "submap",
                  contact.submap == nullptr ? 0 : contact.submap->id.value);
    }
  }

 private:
  [[nodiscard]] bool Passes(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    RobotMotion motion;
    motion.spheres = {{{0, from, options_.radius_m}, {1, to, options_.radius_m}}};
    return motions_->Check(motion)->is_valid;
  }
  /// At heights a voxel apart.
  [[nodiscard]] bool StepPasses(int x, int y, int to_x, int to_y) const {
    const double low_m = options_.min_z_m + options_.radius_m, high_m = options_.max_z_m - options_.radius_m;
    for (double z_m = low_m; z_m <= high_m; z_m += options_.height_step_m) {
      if (!Passes(floor_.Centre(x, y, z_m), floor_.Centre(to_x, to_y, z_m))) return false;
    }
    return true;
  }
  /// At which height the ball is deepest in something.
  [[nodiscard]] std::pair<double, Eigen::Vector3d> Deepest(int x, int y) const {
    const double low_m = options_.min_z_m + options_.radius_m, high_m = options_.max_z_m - options_.radius_m;
    std::pair<double, Eigen::Vector3d> worst{0, floor_.Centre(x, y, low_m)};
    for (double z_m = low_m; z_m <= high_m; z_m += 0.01) {
      const Eigen::Vector3d p = floor_.Centre(x, y, z_m);
      const BodyAnswer answer = bodies_.Check(Capsule{p, p, options_.radius_m});
      if (answer.is_colliding && answer.contacts.front().depth_m >= worst.first) {
        worst = {answer.contacts.front().depth_m, p};
      }
    }
    return worst;
  }

  const PathCheckOptions& options_;
  Floor floor_;
  Result<TrajectoryQuery> motions_;
  BodyQuery bodies_;
};

}  // namespace

Status RunPathCheck(const PathCheckOptions& options) {
  if (!(options.max_z_m - options.min_z_m >= 2 * options.radius_m)) {
    return InvalidArgument("the ball does not fit into the band: it is lower than twice the radius");
  }
  DHPMAP_ASSIGN_OR_RETURN(const Recording recording, MapRecording(options.directory, options.num_frames));
  SurfaceCache cache(std::size_t{1} << 30);
  const auto surfaces = cache.Of(recording.builder->map().Publish(0));
  PathJudge(surfaces, options, UnknownSpace::kFree).Judge("unknown is free");
  PathJudge(surfaces, options, UnknownSpace::kOccupied).Judge("unknown is occupied");
  return Status::Ok();
}

}  // namespace dhpmap::bench
