// SPDX-License-Identifier: BSD-3-Clause
#include <time.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "mapping/pipeline/map_builder.h"
#include "mapping/query/distance_query.h"
#include "mapping/query/point_lookup.h"
#include "tests/bench/bench.h"
#include "tests/bench/frames.h"

namespace dhpmap::bench {
namespace {

constexpr std::size_t kBatch = 2048;  // as the server cuts them

/// CPU time of this thread, which others on the machine change less than the time of day.
double CpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double Seconds(const std::function<void()>& work) {
  const double start_s = CpuSeconds();
  work();
  return CpuSeconds() - start_s;
}

Result<std::shared_ptr<const MapSnapshot>> BuildMap(const QueryBenchOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const LoadedFrames loaded,
                          LoadFrames(options.directory, LabelSource::kPredicted, options.num_frames));
  MapInfo info;
  info.name = "bench";
  DHPMAP_RETURN_IF_ERROR(ApplyPreset(loaded.dataset->preset(), info.config));
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(loaded.dataset->label_classes()));
  info.label_set = std::make_shared<LabelSet>(std::move(label_set));
  MapBuilder builder(info, 0);
  for (const PanopticFrame& frame : loaded.frames) DHPMAP_RETURN_IF_ERROR(builder.Integrate(frame).status());
  (void)builder.Finish();
  return builder.map().Publish(0);
}

/// Some things of the map, moved and turned by up to a metre.
void MoveThings(Map& map, double share, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<SubmapId> things;
  for (const auto& submap : map.submaps()) {
    if (submap->info().panoptic == Panoptic::kThing) things.push_back(submap->id());
  }
  std::shuffle(things.begin(), things.end(), random);
  things.resize(static_cast<std::size_t>(share * static_cast<double>(things.size())));
  for (const SubmapId id : things) {
    Submap& submap = *map.FindMutable(id);
    const Eigen::Vector3d center = submap.BoundingSphereInMap().center_m;
    Transform T = Transform::Identity();
    T.translate(center + Eigen::Vector3d(unit(random), unit(random), 0.2 * unit(random)));
    T.rotate(Eigen::AngleAxisd(3 * unit(random), Eigen::Vector3d::UnitZ()));
    T.translate(-center);
    submap.mutable_info().T_map_submap = T * submap.info().T_map_submap;
  }
  std::printf("%zu of %zu submaps moved\n", things.size(), map.submaps().size());
}

/// Every triangle of a map, for brute force.
struct Soup {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  explicit Soup(const MapSnapshot& map) {
    for (const auto& submap : map.submaps()) {
      const double size_m = submap->info().voxel_size_m;
      for (const TileEntry& tile : submap->blocks().tiles()) {
        const Eigen::Vector3d corner = TileCorner(tile.index, size_m);
        for (const SurfaceTriangle& t :
             ExtractTileSurface(FindNeighbourhood(submap->blocks(), tile.index), tile.index, size_m)) {
          auto& triangle = triangles.emplace_back();
          for (std::size_t i = 0; i < 3; ++i) {
            triangle[i] = submap->info().T_map_submap * (corner + t[i].cast<double>());
          }
        }
      }
    }
  }
  [[nodiscard]] double Distance(const Eigen::Vector3d& p, Eigen::Vector3d& nearest) const {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles) {
      const TriangleCorners local = {(t[0] - p).cast<float>(), (t[1] - p).cast<float>(), (t[2] - p).cast<float>()};
      const Eigen::Vector3d point = NearestPointOf(local, Eigen::Vector3f::Zero()).cast<double>();
      if (point.squaredNorm() < best * best) {
        best = point.norm();
        nearest = p + point;
      }
    }
    return best;
  }
};

struct Kind {
  const char* name;
  std::vector<Eigen::Vector3d> points;
};

/// Near: within 0.1 m of the surface, middle: 0.25 m, far: uniform in the box of the map's things.
std::vector<Kind> Points(const MapSnapshot& map, const Soup& soup, std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::uniform_int_distribution<std::size_t> which(0, soup.triangles.size() - 1);
  const auto around = [&](double reach_m) {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d offset(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
      points.push_back(soup.triangles[which(random)][0] + 2 * reach_m * offset);
    }
    return points;
  };
  Eigen::AlignedBox3d box;
  for (const auto& submap : map.submaps()) {
    if (submap->info().panoptic == Panoptic::kThing) box.extend(submap->BoundingSphereInMap().center_m);
  }
  std::vector<Kind> kinds = {{"near", around(0.1)}, {"middle", around(0.25)}, {"far", {}}};
  for (std::size_t i = 0; i < count; ++i) {
    kinds[2].points.push_back(box.min() +
                              Eigen::Vector3d(unit(random), unit(random), unit(random)).cwiseProduct(box.sizes()));
  }
  return kinds;
}

double Quantile(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void PrintErrors(const Kind& kind, const DistanceQuery& query, const Soup& soup, std::size_t count, double voxel_m) {
  std::vector<double> errors_vox, angles_deg;
  for (std::size_t i = 0; i < std::min(count, kind.points.size()); ++i) {
    const SurfaceDistance answer = query.At(kind.points[i]);
    Eigen::Vector3d nearest;
    const double truth_m = std::min(soup.Distance(kind.points[i], nearest), 3.0);
    errors_vox.push_back(std::abs(std::abs(answer.distance_m) - truth_m) / voxel_m);
    if (answer.submap == nullptr || truth_m < 1e-4) continue;
    const Eigen::Vector3d direction = (kind.points[i] - nearest) / truth_m * (answer.distance_m < 0 ? -1 : 1);
    angles_deg.push_back(std::acos(std::clamp(direction.dot(answer.gradient), -1.0, 1.0)) * 180 / M_PI);
  }
  const double median = Quantile(errors_vox, 0.5), p99 = Quantile(errors_vox, 0.99), most = errors_vox.back();
  std::printf(
      "  %-7s error of distance, voxels: median %.5f p99 %.5f max %.5f; of gradient, degrees: median %.3f p99 %.3f\n",
      kind.name, median, p99, most, Quantile(angles_deg, 0.5), Quantile(angles_deg, 0.99));
}

void Measure(const char* what, const std::vector<Kind>& kinds,
             const std::function<void(std::span<const Eigen::Vector3d>)>& ask) {
  std::printf("  %-34s", what);
  for (const Kind& kind : kinds) {
    double best_s = std::numeric_limits<double>::infinity();
    for (int repetition = 0; repetition < 3; ++repetition) {
      best_s = std::min(best_s, Seconds([&] {
                          const std::span<const Eigen::Vector3d> all(kind.points);
                          for (std::size_t i = 0; i < all.size(); i += kBatch)
                            ask(all.subspan(i, std::min(kBatch, all.size() - i)));
                        }));
    }
    std::printf(" %8.3f", 1e-6 * static_cast<double>(kind.points.size()) / best_s);
  }
  std::printf("\n");
}

void MeasureState(const std::shared_ptr<const MapSnapshot>& map, SurfaceCache& cache,
                  const QueryBenchOptions& options) {
  std::mt19937 random(1);
  std::shared_ptr<const MapSurfaces> surfaces;
  const double index_s = Seconds([&] { surfaces = cache.Of(map); });
  const DistanceQuery query(surfaces, {});
  const Soup soup(*map);
  const std::vector<Kind> kinds = Points(*map, soup, options.num_points, random);
  std::vector<SurfaceDistance> answers(kBatch);
  const double cold_s = Seconds([&] {
    for (const Kind& kind : kinds) query.At(std::span(kind.points).first(kBatch), answers);
  });
  std::printf("%zu submaps, %zu tiles, %zu triangles; index %.1f ms, first %zu points %.1f ms, surfaces %.1f MB\n",
              map->submaps().size(), cache.num_tiles(), soup.triangles.size(), 1e3 * index_s, 3 * kBatch, 1e3 * cold_s,
              static_cast<double>(cache.bytes()) / 1e6);
  std::printf("  M points a second, one core            near   middle      far\n");
  const PointLookup lookup(map);
  std::size_t num_observed = 0;
  Measure("voxel at the point (QueryPoints)", kinds, [&](auto points) {
    for (const Eigen::Vector3d& p : points) num_observed += lookup.At(p).is_observed;
  });
  double sum_m = 0;
  Measure("distance, gradient, object: single", kinds, [&](auto points) {
    for (const Eigen::Vector3d& p : points) sum_m += query.At(p).distance_m;
  });
  Measure("the same in batches of 2,048", kinds,
          [&](auto points) { query.At(points, std::span(answers).first(points.size())); });
  std::vector<Kind> coherent = kinds;
  for (Kind& kind : coherent) {
    std::sort(kind.points.begin(), kind.points.end(), [](const auto& a, const auto& b) {
      return std::floor(2 * a.x()) != std::floor(2 * b.x()) ? a.x() < b.x() : a.y() < b.y();
    });
  }
  Measure("batches of points close together", coherent,
          [&](auto points) { query.At(points, std::span(answers).first(points.size())); });
  for (const Kind& kind : kinds) PrintErrors(kind, query, soup, options.num_checked, map->info().config.voxel_size_m);
  std::printf("  (%zu observed, %.0f m)\n", num_observed, sum_m);
}

}  // namespace

Status RunQueryBench(const QueryBenchOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const auto built, BuildMap(options));
  std::mt19937 random(7);
  Map map(built);
  SurfaceCache cache(std::size_t{4} << 30);
  std::printf("as mapped: ");
  MeasureState(map.Publish(0), cache, options);
  MoveThings(map, 1.0 / 3, random);
  std::printf("moved: ");
  MeasureState(map.Publish(0), cache, options);
  return Status::Ok();
}

}  // namespace dhpmap::bench
