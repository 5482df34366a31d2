// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "mapping/geometry/point_order.h"
#include "mapping/mesh/map_mesh.h"
#include "mapping/query/distance_query.h"
#include "mapping/query/point_lookup.h"
#include "mapping/query/ray_query.h"
#include "tests/bench/bench.h"
#include "tests/bench/check_bench.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/first_distances.h"
#include "tests/bench/frames.h"
#include "tests/bench/quiet_edits.h"
#include "tests/bench/recording.h"
#include "tests/support/tsdf_sampler.h"

namespace dhpmap::bench {
namespace {

constexpr std::size_t kBatch = 2048;  // as the server cuts them

/// What an addition takes that waits for the one before: a cycle. Tells how much of the core others have.
double NanosecondsACycle() {
  constexpr int kCount = 100000000;
  const double start_s = ThreadCpu_s();
  for (int i = 0; i < kCount; ++i) asm volatile("" : "+r"(i));
  return 1e9 * (ThreadCpu_s() - start_s) / kCount;
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
    T.translate(center + Eigen::Vector3d{unit(random), unit(random), 0.2 * unit(random)});
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
    ThreadPool pool(0);
    const Mesh mesh = ExtractMapMesh(map, MeshColoring::kInstance, pool);
    for (const auto& t : mesh.triangles) {
      auto& triangle = triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) triangle[i] = mesh.vertices_m[t[i]].cast<double>();
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
      const Eigen::Vector3d offset{unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
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
                              Eigen::Vector3d{unit(random), unit(random), unit(random)}.cwiseProduct(box.sizes()));
  }
  return kinds;
}

double SortedQuantile(std::vector<double>& values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
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
  const double median = SortedQuantile(errors_vox, 0.5), p99 = SortedQuantile(errors_vox, 0.99),
               most = SortedQuantile(errors_vox, 1);
  std::printf(
      "  %-7s error of distance, voxels: median %.5f p99 %.5f max %.5f; of gradient, degrees: median %.3f p99 %.3f\n",
      kind.name, median, p99, most, SortedQuantile(angles_deg, 0.5), SortedQuantile(angles_deg, 0.99));
}

/// Near fields against the exact search, at all points.
void PrintFieldErrors(const Kind& kind, const DistanceQuery& quick, const DistanceQuery& exact, double voxel_m) {
  std::vector<double> errors_vox, angles_deg;
  std::size_t num_half = 0, num_sides = 0, num_states = 0;
  std::vector<SurfaceDistance> a(kind.points.size()), b(kind.points.size());
  quick.At(kind.points, a);
  exact.At(kind.points, b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    errors_vox.push_back(std::abs(std::abs(a[i].distance_m) - std::abs(b[i].distance_m)) / voxel_m);
    num_half += std::abs(a[i].distance_m - b[i].distance_m) > 0.5 * voxel_m;
    num_states += a[i].status != b[i].status;
    if (a[i].submap == nullptr || b[i].submap == nullptr) continue;
    num_sides += (a[i].distance_m < 0) != (b[i].distance_m < 0);
    angles_deg.push_back(std::acos(std::clamp(a[i].gradient.dot(b[i].gradient), -1.0, 1.0)) * 180 / M_PI);
  }
  const double median = SortedQuantile(errors_vox, 0.5), p99 = SortedQuantile(errors_vox, 0.99),
               most = SortedQuantile(errors_vox, 1);
  std::printf(
      "  %-7s fields: error of distance, voxels: median %.5f p99 %.5f max %.5f; of gradient, degrees: median %.3f p99 "
      "%.3f; of %zu beyond half a voxel %zu (other side %zu), other status %zu\n",
      kind.name, median, p99, most, SortedQuantile(angles_deg, 0.5), SortedQuantile(angles_deg, 0.99), a.size(),
      num_half, num_sides, num_states);
}

void Measure(const char* what, const std::vector<Kind>& kinds,
             const std::function<void(std::span<const Eigen::Vector3d>)>& ask, int repetitions = 3) {
  std::printf("  %-36s", what);
  for (const Kind& kind : kinds) {
    double best_s = std::numeric_limits<double>::infinity();
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      best_s = std::min(best_s, CpuOf_s([&] {
                          const std::span<const Eigen::Vector3d> all(kind.points);
                          for (std::size_t i = 0; i < all.size(); i += kBatch)
                            ask(all.subspan(i, std::min(kBatch, all.size() - i)));
                        }));
    }
    std::printf(" %8.3f", 1e-6 * static_cast<double>(kind.points.size()) / best_s);
  }
  std::printf("\n");
}

/// The points in an order in which a planner may ask: each close to the one before.
std::vector<Kind> InOrder(std::vector<Kind> kinds) {
  for (Kind& kind : kinds) {
    std::vector<Eigen::Vector3d> points;
    for (const std::uint32_t i : OrderAlongCurve(kind.points)) points.push_back(kind.points[i]);
    kind.points = std::move(points);
  }
  return kinds;
}

/// The TSDF itself, of the submap that has most of it, where it was observed.
void MeasureTsdf(const MapSnapshot& map, std::size_t num_points, std::mt19937& random) {
  const auto& submaps = map.submaps();
  const Submap& submap = **std::max_element(submaps.begin(), submaps.end(), [](const auto& a, const auto& b) {
    return a->blocks().size() < b->blocks().size();
  });
  std::vector<BlockIndex> blocks;
  for (const BlockEntry& block : submap.blocks().entries()) blocks.push_back(block.index);
  std::uniform_real_distribution<double> unit(0, 1);
  const double size_m = submap.info().voxel_size_m;
  std::vector<Kind> kinds = {{"block by block", {}}};
  for (std::size_t i = 0; i < num_points; ++i) {
    const Eigen::Vector3d corner = BlockCorner(blocks[i * blocks.size() / num_points], size_m);
    kinds[0].points.push_back(corner + kBlockSide * size_m * Eigen::Vector3d{unit(random), unit(random), unit(random)});
  }
  std::vector<Kind> shuffled = kinds;
  std::shuffle(shuffled[0].points.begin(), shuffled[0].points.end(), random);
  kinds.push_back({"random", std::move(shuffled[0].points)});
  double sum = 0;
  std::printf("  TSDF of one submap                 coherent   random\n");
  Measure("voxel", kinds, [&](auto points) {
    testing::TsdfSampler sampler(submap);
    for (const Eigen::Vector3d& p : points) {
      const float value = sampler.At(VoxelAt(p, size_m));
      sum += value > 0 ? value : 0;
    }
  });
  Measure("trilinear, with gradient", kinds, [&](auto points) {
    testing::TsdfSampler sampler(submap);
    for (const Eigen::Vector3d& p : points) sum += sampler.Between(p).distance_m;
  });
  std::printf("  (%.0f m)\n", sum);
}

void MeasureRays(const std::shared_ptr<const MapSurfaces>& surfaces, const std::vector<Kind>& kinds,
                 std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<Kind> few = kinds;
  for (Kind& kind : few) kind.points.resize(std::min<std::size_t>(kind.points.size(), 5000));
  const RayQuery rays(surfaces, {.unknown_is_free = true}), seen(surfaces, {});
  double sum_m = 0;
  const auto cast = [&](const RayQuery& query, auto points) {
    for (const Eigen::Vector3d& p : points) {
      const Eigen::Vector3d direction{normal(random), normal(random), normal(random)};
      sum_m += query.Cast({p, direction.normalized()}).distance_m;
    }
  };
  Measure("rays, first hit within 3 m", few, [&](auto points) { cast(rays, points); });
  Measure("the same, and where unknown begins", few, [&](auto points) { cast(seen, points); });
  std::printf("  (%.0f m)\n", sum_m);
}

void MeasureFields(const std::shared_ptr<const MapSurfaces>& surfaces, const SurfaceCache& cache,
                   const std::vector<Kind>& kinds, const std::vector<Kind>& coherent, const DistanceQuery& exact) {
  const DistanceQuery quick(surfaces, {.tolerance_vox = 0.5});
  std::vector<SurfaceDistance> answers(kBatch);
  const auto in_batches = [&](auto points) { quick.At(points, std::span(answers).first(points.size())); };
  const std::size_t before = cache.cell_bytes(), num_before = surfaces->fields().store()->num_fields();
  Measure("fields, batches, while they come", coherent, in_batches, 1);
  for (int n = 0; n < 70; ++n) {  // the others of those cells, until all are there that these points want
    for (const Kind& kind : coherent) {
      for (std::size_t i = static_cast<std::size_t>(n) % 7; i < kind.points.size(); i += 7)
        (void)quick.At(kind.points[i]);
    }
  }
  const auto num_more = static_cast<std::int64_t>(surfaces->fields().store()->num_fields()) -
                        static_cast<std::int64_t>(num_before);  // those near what has moved are dropped when asked for
  std::printf("  %zu fields, %+lld; with what is known of cells in this state %+.1f MB\n", num_before,
              static_cast<long long>(num_more),
              (static_cast<double>(cache.cell_bytes()) - static_cast<double>(before)) / 1e6);
  Measure("fields, batches of random points", kinds, in_batches);
  Measure("fields, batches close together", coherent, in_batches);
  const auto single = [&](auto points) {
    for (const Eigen::Vector3d& p : points) (void)quick.At(p);
  };
  Measure("fields, single random points", kinds, single);
  Measure("fields, single, close together", coherent, single);
  const double voxel_m = surfaces->state().info().config.voxel_size_m;
  for (const Kind& kind : kinds) PrintFieldErrors(kind, quick, exact, voxel_m);
}

/// One thing moves by 30 cm: how soon the first answers near it come, and when they come as fast as before.
void MeasureMove(const std::shared_ptr<const MapSnapshot>& map, SurfaceCache& cache, std::mt19937& random) {
  const Submap* thing = nullptr;
  for (const auto& submap : map->submaps()) {
    const bool is_better = submap->info().panoptic == Panoptic::kThing && submap->bounding_sphere().radius_m < 0.8 &&
                           (thing == nullptr || submap->blocks().size() > thing->blocks().size());
    if (is_better) thing = submap.get();
  }
  if (thing == nullptr) return;
  const BoundingSphere sphere = thing->BoundingSphereInMap();
  std::uniform_real_distribution<double> unit(-1.5, 1.5);
  std::vector<Eigen::Vector3d> points(20000);
  for (Eigen::Vector3d& p : points) p = sphere.center_m + Eigen::Vector3d{unit(random), unit(random), unit(random)};
  const DistanceOptions options{.tolerance_vox = 0.5};
  std::vector<SurfaceDistance> answers(kBatch);
  const auto pass = [&](const DistanceQuery& query) {
    return CpuOf_s([&] {
      for (std::size_t i = 0; i < points.size(); i += kBatch) {
        const auto batch = std::span(points).subspan(i, std::min(kBatch, points.size() - i));
        query.At(batch, std::span(answers).first(batch.size()));
      }
    });
  };
  const DistanceQuery still(cache.Of(map), options);
  double steady_s = 1;
  for (int n = 0; n < 200; ++n) steady_s = std::min(steady_s, pass(still));
  Map next(map);
  next.FindMutable(thing->id())->mutable_info().T_map_submap.pretranslate(Eigen::Vector3d(0.3, 0, 0));
  const auto moved = next.Publish(1);
  std::shared_ptr<const MapSurfaces> surfaces;
  const double first_s = CpuOf_s([&] {
    surfaces = cache.Of(moved);
    DistanceQuery(surfaces, options).At(std::span(points).first(100), std::span(answers).first(100));
  });
  const DistanceQuery query(surfaces, options);
  double sum_s = 0, now_s = 1;
  int num_passes = 0;
  for (; num_passes < 200 && now_s > 1.25 * steady_s; ++num_passes) sum_s += now_s = pass(query);
  std::printf(
      "after a thing of %.1f m moved: first 100 points %.2f ms; %.2f M/s as before after %d passes of 20,000, %.0f "
      "ms\n",
      2 * sphere.radius_m, 1e3 * first_s, 0.02 / now_s, num_passes, 1e3 * sum_s);
}

void MeasureState(const std::shared_ptr<const MapSnapshot>& map, SurfaceCache& cache,
                  const QueryBenchOptions& options) {
  std::mt19937 random(1);
  std::shared_ptr<const MapSurfaces> surfaces;
  const double index_s = CpuOf_s([&] { surfaces = cache.Of(map); });
  const DistanceQuery query(surfaces, {});
  const Soup soup(*map);
  const std::vector<Kind> kinds = Points(*map, soup, options.num_points, random), coherent = InOrder(kinds);
  std::vector<SurfaceDistance> answers(kBatch);
  const std::size_t num_first = std::min(kBatch, options.num_points);
  const double first_s = CpuOf_s([&] { query.At(std::span(kinds[0].points).first(10), answers); });
  const double cold_s = CpuOf_s([&] {
    for (const Kind& kind : kinds) query.At(std::span(kind.points).first(num_first), answers);
  });
  std::printf("%zu submaps, %zu tiles, %zu triangles; index %.2f ms, first 10 points %.2f ms, first %zu %.1f ms\n",
              map->submaps().size(), cache.num_tiles(), soup.triangles.size(), 1e3 * index_s, 1e3 * first_s,
              3 * num_first, 1e3 * cold_s);
  std::printf("  M a second, one core                   near   middle      far\n");
  const auto in_batches = [&](auto points) { query.At(points, std::span(answers).first(points.size())); };
  Measure("distances, batches, while cells come", kinds, in_batches, 1);
  Measure("distances, batches of random points", kinds, in_batches);
  Measure("distances, batches close together", coherent, in_batches);
  double sum_m = 0;
  const auto single = [&](auto points) {
    for (const Eigen::Vector3d& p : points) sum_m += query.At(p).distance_m;
  };
  Measure("distances, single random points", kinds, single);
  Measure("distances, single, close together", coherent, single);
  MeasureFields(surfaces, cache, kinds, coherent, query);
  if (options.only_distances) return;
  std::size_t count = 0;
  const auto touches = [&](auto points) {
    for (const Eigen::Vector3d& p : points) count += query.AnyCloserThan(p, 0.1);
  };
  Measure("spheres of 0.1 m, yes or no, random", kinds, touches);
  Measure("the same, close together", coherent, touches);
  const PointLookup lookup(map);
  const auto look_up = [&](auto points) {
    for (const Eigen::Vector3d& p : points) count += lookup.At(p).is_observed;
  };
  Measure("voxel of the map, random", kinds, look_up);
  Measure("voxel of the map, close together", coherent, look_up);
  MeasureRays(surfaces, kinds, random);
  MeasureTsdf(*map, options.num_points, random);
  std::printf("  surfaces %.1f MB, cells %.1f MB\n", static_cast<double>(cache.bytes()) / 1e6,
              static_cast<double>(cache.cell_bytes()) / 1e6);
  for (const Kind& kind : kinds) PrintErrors(kind, query, soup, options.num_checked, map->info().config.voxel_size_m);
  std::printf("  (%zu, %.0f m)\n", count, sum_m);
  MeasureChecks(surfaces);
}

/// So many copies of a thing, each somewhere in a flat of so much room that there is one to 4 m3.
std::shared_ptr<const MapSnapshot> Copies(const MapSnapshot& map, std::size_t count, std::mt19937& random) {
  const Submap* thing = nullptr;
  for (const auto& submap : map.submaps()) {
    const bool is_better = submap->info().panoptic == Panoptic::kThing &&
                           (thing == nullptr || (submap->blocks().size() > thing->blocks().size() &&
                                                 submap->bounding_sphere().radius_m < 0.8));
    if (is_better) thing = submap.get();
  }
  Map copies(std::make_shared<const MapSnapshot>(map));
  const SubmapId original = thing->id();
  const Eigen::Vector3d center = thing->BoundingSphereInMap().center_m;
  const double side_m = std::sqrt(4.0 * static_cast<double>(count) / 2.5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t i = 0; i < count; ++i) {
    Transform T = Transform::Identity();
    T.translate(Eigen::Vector3d{side_m * unit(random), side_m * unit(random), 2.5 * unit(random)});
    T.rotate(Eigen::AngleAxisd(6 * unit(random), Eigen::Vector3d::UnitZ()));
    T.translate(-center);
    Submap& copy = *copies.Clone(original);
    copy.mutable_info().T_map_submap = T * copy.info().T_map_submap;
  }
  std::vector<SubmapId> others;
  for (const auto& submap : map.submaps()) {
    if (submap->id() != kUnknownSubmap) others.push_back(submap->id());
  }
  for (const SubmapId id : others) (void)copies.Remove(id);
  return copies.Publish(0);
}

/// How the time of a query grows with the number of submaps, against a look at every submap's box.
void MeasureGrowth(const MapSnapshot& map, std::size_t num_points) {
  std::printf("of copies of one thing      10      100    1,000   10,000\n");
  std::vector<double> index_ms, moved_ms, M_a_s, linear_M_a_s;
  for (const std::size_t count : {10u, 100u, 1000u, 10000u}) {
    std::mt19937 random(5);
    const auto state = Copies(map, count, random);
    SurfaceCache cache(std::size_t{4} << 30);
    std::shared_ptr<const MapSurfaces> surfaces;
    index_ms.push_back(1e3 * CpuOf_s([&] { surfaces = cache.Of(state); }));
    const Eigen::AlignedBox3d& box = surfaces->index().box_m();
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < num_points; ++i) {
      points.push_back(box.min() + Eigen::Vector3d{unit(random), unit(random), unit(random)}.cwiseProduct(box.sizes()));
    }
    const DistanceQuery query(surfaces, {});
    std::vector<SurfaceDistance> answers(kBatch);
    double best_s = std::numeric_limits<double>::infinity();
    for (int repetition = 0; repetition < 3; ++repetition) {
      best_s = std::min(best_s, CpuOf_s([&] {
                          for (std::size_t i = 0; i < points.size(); i += kBatch) {
                            const auto batch = std::span(points).subspan(i, std::min(kBatch, points.size() - i));
                            query.At(batch, std::span(answers).first(batch.size()));
                          }
                        }));
    }
    M_a_s.push_back(1e-6 * static_cast<double>(points.size()) / best_s);
    const std::size_t num_linear = std::min<std::size_t>(points.size(), 1 + 2000000 / count);
    double least_m2 = 0;
    const double linear_s = CpuOf_s([&] {
      for (std::size_t i = 0; i < num_linear; ++i) {
        double best2 = std::numeric_limits<double>::infinity();
        for (const SubmapIndex::Entry& entry : surfaces->index().entries()) {
          best2 = std::min(best2, entry.box_m().squaredExteriorDistance(entry.ToSubmap(points[i])));
        }
        least_m2 += best2;
      }
    });
    linear_M_a_s.push_back(1e-6 * static_cast<double>(num_linear) / linear_s + 0 * least_m2);
    Map next(state);
    next.FindMutable(next.submaps().back()->id())->mutable_info().T_map_submap.translation().x() += 0.1;
    const auto moved = next.Publish(1);
    moved_ms.push_back(1e3 * CpuOf_s([&] { (void)cache.Of(moved); }));
  }
  const auto row = [](const char* name, const std::vector<double>& values) {
    std::printf("  %-20s", name);
    for (const double value : values) std::printf(" %8.3f", value);
    std::printf("\n");
  };
  row("distances, M/s", M_a_s);
  row("boxes one by one", linear_M_a_s);
  row("index, ms", index_ms);
  row("after a move, ms", moved_ms);
}

}  // namespace

Status RunQueryBench(const QueryBenchOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const Recording recording, MapRecording(options.directory, options.num_frames));
  const auto built = recording.builder->map().Publish(0);
  std::mt19937 random(7);
  Map map(built);
  SurfaceCache cache(std::size_t{4} << 30);
  if (options.only_edits) {
    MeasureQuietEdits(map.Publish(0), cache, random);
    return Status::Ok();
  }
  if (options.only_first) {
    MeasureFirstDistances(map.Publish(0), random);
    return Status::Ok();
  }
  std::printf("a cycle takes %.2f ns: on a core that others use, too, everything takes as much longer\nas mapped: ",
              NanosecondsACycle());
  MeasureState(map.Publish(0), cache, options);
  MoveThings(map, 1.0 / 3, random);
  std::printf("moved: ");
  const auto moved = map.Publish(0);
  MeasureState(moved, cache, options);
  MeasureMove(moved, cache, random);
  MeasureQuietEdits(moved, cache, random);
  if (options.only_distances) return Status::Ok();
  MeasureGrowth(*built, options.num_points);
  return Status::Ok();
}

}  // namespace dhpmap::bench
