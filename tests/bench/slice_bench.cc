// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "mapping/query/occupancy_slice.h"
#include "tests/bench/bench.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/recording.h"

namespace dhpmap::bench {
namespace {

/// A slice of all that is known in a band, in a way that tells whether two are the same.
struct MadeSlice {
  double took_s = 0;
  std::size_t num_free = 0, num_occupied = 0;
  std::uint64_t hash = 14695981039346656037u;

  void Add(std::int64_t value) { hash = (hash ^ static_cast<std::uint64_t>(value)) * 1099511628211u; }
};

MadeSlice MakeSlice(const std::shared_ptr<const MapSurfaces>& surfaces, const SliceBenchOptions& options,
                    std::int8_t unknown) {
  SliceOptions slice{
      .min_z_m = options.min_z_m, .max_z_m = options.max_z_m, .unknown = unknown, .with_objects = options.objects};
  slice.resolution_m = surfaces->state().info().config.voxel_size_m;
  MadeSlice made;
  const auto area = KnownArea(*surfaces, slice);
  if (!area) return made;
  const Eigen::Array2d low = (area->min().array() / slice.resolution_m).floor();
  const Eigen::Array2d high = (area->max().array() / slice.resolution_m).ceil();
  slice.min_m = low * slice.resolution_m;
  slice.width = static_cast<int>(high.x() - low.x());
  slice.height = static_cast<int>(high.y() - low.y());
  std::vector<std::int8_t> row(static_cast<std::size_t>(slice.width));
  std::vector<const SubmapInfo*> objects(slice.with_objects ? row.size() : 0);
  const double start_s = ThreadCpu_s();
  OccupancySlice cells(surfaces, slice);
  for (int y = 0; y < slice.height; ++y) {
    cells.Row(y, row, objects);
    for (const std::int8_t cell : row) {
      made.num_free += cell == kFreeCell ? 1 : 0;
      made.num_occupied += cell == kOccupiedCell ? 1 : 0;
      made.Add(cell);
    }
    for (const SubmapInfo* object : objects) made.Add(object == nullptr ? -1 : object->id.value);
  }
  made.took_s = ThreadCpu_s() - start_s;
  return made;
}

void Print(const char* unknown, const char* when, const MadeSlice& made) {
  std::printf("unknown is %-8s %-28s %7.1f ms, %zu free, %zu occupied, %016llx\n", unknown, when, 1e3 * made.took_s,
              made.num_free, made.num_occupied, static_cast<unsigned long long>(made.hash));
}

/// The state with the thing that has most blocks moved by half a metre.
std::shared_ptr<const MapSnapshot> WithAThingMoved(const std::shared_ptr<const MapSnapshot>& state) {
  const Submap* largest = nullptr;
  for (const auto& submap : state->submaps()) {
    const bool is_there = submap->info().panoptic == Panoptic::kThing && !submap->IsAbsent();
    if (!is_there || (largest != nullptr && submap->blocks().size() <= largest->blocks().size())) continue;
    largest = submap.get();
  }
  Map next(state);
  if (largest != nullptr) {
    next.FindMutable(largest->id())->mutable_info().T_map_submap.pretranslate(Eigen::Vector3d(0.5, 0, 0));
  }
  return next.Publish(1);
}

}  // namespace

Status RunSliceBench(const SliceBenchOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const Recording recording, MapRecording(options.directory, options.num_frames));
  const auto state = recording.builder->map().Publish(0), moved = WithAThingMoved(state);
  constexpr struct {
    const char* name;
    std::int8_t cell;
  } kPolicies[] = {{"unknown", kUnknownCell}, {"occupied", kOccupiedCell}, {"free", kFreeCell}};
  for (const auto& policy : kPolicies) {
    SurfaceCache cache(std::size_t{1} << 30);
    const auto first = cache.Of(state);
    Print(policy.name, "first, surfaces and all:", MakeSlice(first, options, policy.cell));
    for (int n = 0; n < 2; ++n) Print(policy.name, "again:", MakeSlice(first, options, policy.cell));
    const auto after = cache.Of(moved);
    Print(policy.name, "first after a thing moved:", MakeSlice(after, options, policy.cell));
    SurfaceCache other(std::size_t{1} << 30);
    Print(policy.name, "the same, asked first:", MakeSlice(other.Of(moved), options, policy.cell));
  }
  return Status::Ok();
}

}  // namespace dhpmap::bench
