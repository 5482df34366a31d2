// SPDX-License-Identifier: BSD-3-Clause
// What each edit costs on objects of a given size, as a server makes it: on the map's writer, and until it is stored.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/guarded.h"
#include "mapping/map/history_id.h"
#include "server/app/edits/edit_list.h"
#include "server/app/edits/edit_summary.h"
#include "server/app/maps/map_registry.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "tests/bench/bench.h"

namespace dhpmap::bench {
namespace {

namespace fs = std::filesystem;
using EditClock = std::chrono::steady_clock;

constexpr double kVoxel_m = 0.05;
constexpr int kBand_vox = 2;  ///< of the surface, on either side
constexpr ClassId kCup{1}, kBowl{2};
constexpr char kMapOfEdits[] = "bench";
constexpr char kEditor[] = "bench";

double MsSince(EditClock::time_point begin) {
  return std::chrono::duration<double, std::milli>(EditClock::now() - begin).count();
}

double MedianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

/// The radius of a ball whose band holds about so many voxels.
double RadiusOfBall_vox(double num_voxels) { return std::sqrt(num_voxels / (4 * std::numbers::pi * 2 * kBand_vox)); }

/// The band of one block's voxels around a sphere; returns how many there are.
std::int64_t WriteBand(const Eigen::Vector3d& center_m, double radius_m, BlockIndex index, Submap& submap) {
  std::int64_t num_voxels = 0;
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    const double distance_m = (VoxelCentre(VoxelIn(index, linear), kVoxel_m) - center_m).norm() - radius_m;
    if (std::abs(distance_m) > kBand_vox * kVoxel_m) continue;
    TsdfBlock& tsdf = submap.MutableTsdf(index);
    const auto i = static_cast<std::size_t>(linear);
    tsdf.distance_m[i] = static_cast<float>(distance_m);
    tsdf.weight[i] = 5;
    tsdf.color[i] = {200, 120, 40};
    submap.MutableLabels(index).AddObservation(linear, kCup);
    ++num_voxels;
  }
  return num_voxels;
}

std::int64_t AddBall(const Eigen::Vector3d& center_m, double radius_m, Submap& submap) {
  const double block_m = kVoxel_m * kBlockSide, reach_m = radius_m + kBand_vox * kVoxel_m;
  const BlockIndex low = BlockOf(VoxelAt(center_m - Eigen::Vector3d::Constant(reach_m), kVoxel_m));
  const BlockIndex high = BlockOf(VoxelAt(center_m + Eigen::Vector3d::Constant(reach_m), kVoxel_m));
  std::int64_t num_voxels = 0;
  for (std::int32_t z = low.z; z <= high.z; ++z) {
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t x = low.x; x <= high.x; ++x) {
        const Eigen::Vector3d middle_m = (Eigen::Vector3d(x, y, z) + Eigen::Vector3d::Constant(0.5)) * block_m;
        if (std::abs((middle_m - center_m).norm() - radius_m) > block_m) continue;
        num_voxels += WriteBand(center_m, radius_m, {x, y, z}, submap);
      }
    }
  }
  return num_voxels;
}

/// Things of one size: a ball, another beside it, and two balls of half the voxels that are one thing.
struct Things {
  SubmapId ball, beside, pair;
  std::int64_t num_voxels = 0;  ///< of the ball
  double radius_m = 0;
};

Submap& AddThing(Map& map) {
  SubmapInfo info;
  info.panoptic = Panoptic::kThing;
  info.class_id = kCup;
  info.voxel_size_m = kVoxel_m;
  info.truncation_m = kBand_vox * kVoxel_m;
  info.activity = Activity::kInactive;
  info.num_frames_observed = 10;
  return map.Create(std::move(info));
}

Things MakeThings(double num_voxels, Map& map) {
  Things made;
  made.radius_m = RadiusOfBall_vox(num_voxels) * kVoxel_m;
  const double step_m = 2 * made.radius_m + 10 * kVoxel_m, half_m = RadiusOfBall_vox(num_voxels / 2) * kVoxel_m;
  const auto finish = [](Submap& submap, std::int64_t count) {
    submap.AddClassObservations(kCup, static_cast<std::uint64_t>(count));
    submap.UpdateBoundingSphere();
    return submap.id();
  };
  Submap& ball = AddThing(map);
  made.num_voxels = AddBall({0, 0, 0}, made.radius_m, ball);
  made.ball = finish(ball, made.num_voxels);
  Submap& beside = AddThing(map);
  made.beside = finish(beside, AddBall({0, step_m, 0}, made.radius_m, beside));
  Submap& pair = AddThing(map);
  std::int64_t num_of_pair = AddBall({0, 2 * step_m, 0}, half_m, pair);
  num_of_pair += AddBall({0, 3 * step_m, 0}, half_m, pair);
  made.pair = finish(pair, num_of_pair);
  return made;
}

/// One edit that is measured, on what another may have made of the map before.
struct MeasuredEdit {
  std::string name;
  std::vector<Edit> edits;  ///< empty: brings back what `before` has deleted
  std::vector<Edit> before = {};
};

SubmapPatch MovedBy(double x_m) {
  SubmapPatch patch;
  patch.T_map_submap = Transform(Eigen::Translation3d(x_m, 0, 0));
  return patch;
}

Eigen::AlignedBox3d HalfOf(const Things& things) {
  const Eigen::Vector3d reach_m = Eigen::Vector3d::Constant(things.radius_m + 2 * kBand_vox * kVoxel_m);
  return {Eigen::Vector3d(0, -reach_m.y(), -reach_m.z()), reach_m};
}

std::vector<MeasuredEdit> EditsOf(const Things& things) {
  const auto on = [](SubmapId id, auto action) { return Edit{.target = id, .etag = "", .action = std::move(action)}; };
  const auto of_map = [](auto action) { return Edit{.target = std::nullopt, .etag = "", .action = std::move(action)}; };
  SubmapPatch relabelled, renamed, locked;
  relabelled.class_id = kBowl;
  renamed.display_name = "the bowl";
  locked.is_locked = true;
  const SubmapId ball = things.ball;
  return {
      {"rename", {on(ball, PatchEdit{renamed})}},
      {"relabel", {on(ball, PatchEdit{relabelled})}},
      {"lock", {on(ball, PatchEdit{locked})}},
      {"mark as absent", {on(ball, PresenceEdit{Presence::kAbsent})}},
      {"move, first", {on(ball, PatchEdit{MovedBy(1)})}},
      {"move, again", {on(ball, PatchEdit{MovedBy(2)})}, {on(ball, PatchEdit{MovedBy(1)})}},
      {"clone", {on(ball, CloneEdit{MovedBy(1)})}},
      {"delete", {on(ball, DeleteEdit{})}},
      {"undelete", {}, {on(ball, DeleteEdit{})}},
      {"merge", {on(ball, MergeEdit{{things.beside}})}},
      {"split by box", {on(ball, SplitEdit{SplitByBox{HalfOf(things)}})}},
      {"split by plane", {on(ball, SplitEdit{SplitByPlane{}})}},
      {"split into parts", {on(things.pair, SplitEdit{SplitByParts{}})}},
      {"clear box", {on(ball, ClearEdit{.region = HalfOf(things), .classes = {}})}},
      {"clear box of all", {of_map(ClearEdit{.region = HalfOf(things), .classes = {}})}},
      {"clear sphere",
       {on(ball, ClearEdit{.region = BoundingSphere{{0, 0, things.radius_m}, things.radius_m / 2}, .classes = {}})}},
      {"keep clear", {of_map(KeepClearEdit{{"door", HalfOf(things)}})}}};
}

/// A map in a database, with its session.
class EditedMap {
 public:
  explicit EditedMap(const fs::path& folder) : path_((folder / "maps.db").string()) {}

  Status Begin(double num_voxels) {
    SqliteStoreOptions store_options;
    store_options.edits.max_history_bytes = std::int64_t{4} << 30;
    DHPMAP_ASSIGN_OR_RETURN(store_, OpenSqliteStore(path_, store_options));
    DHPMAP_ASSIGN_OR_RETURN(registry_, MapRegistry::Open(*store_, OpenMapOptions{}, {.idle_close_s = 0}));
    MapInfo info;
    info.name = kMapOfEdits;
    info.config.voxel_size_m = kVoxel_m;
    info.config.truncation_m = kBand_vox * kVoxel_m;
    DHPMAP_ASSIGN_OR_RETURN(LabelSet labels,
                            LabelSet::Create({{.id = kCup, .name = "cup"}, {.id = kBowl, .name = "bowl"}}));
    info.label_set = std::make_shared<LabelSet>(std::move(labels));
    DHPMAP_RETURN_IF_ERROR(registry_->Create(std::move(info)).status());
    DHPMAP_ASSIGN_OR_RETURN(session_, registry_->GetOpen(kMapOfEdits));
    return Do([&](Map& map) -> Result<EditMade> {
      things_ = MakeThings(num_voxels, map);
      return EditMade{};
    });
  }
  [[nodiscard]] const Things& things() const { return things_; }

  /// Waits until it is stored.
  Status Do(std::function<Result<EditMade>(Map&)> change) {
    std::promise<Status> done;
    session_->Edit(EditRequest{.change = std::move(change), .source = {.author = kEditor}},
                   [&done](const Result<EditOutcome>& outcome) { done.set_value(outcome.status()); });
    return done.get_future().get();
  }
  /// Waits until nothing is left to be stored, nor anything that an edit has left for after its answer.
  Status Rest() {
    std::promise<Status> done;
    session_->Flush([&done](const Status& stored) { done.set_value(CopyOf(stored)); });
    return done.get_future().get();
  }
  Status Undo(std::size_t count) { return Do(registry_->UndoOf({.count = count, .author = kEditor})); }

  /// The list, or else that what it was deleted by is undone.
  std::function<Result<EditMade>(Map&)> ChangeOf(const std::vector<Edit>& edits) {
    if (edits.empty()) return registry_->UndeletionOf(things_.ball);
    return [list = EditList{.edits = edits}](Map& map) -> Result<EditMade> {
      DHPMAP_ASSIGN_OR_RETURN(const std::vector<EditResult> results, ApplyEdits(list, map));
      return EditMade{.submap = SubmapId(), .summary = SummaryOfList(list, results)};
    };
  }

 private:
  const std::string path_;
  std::unique_ptr<MapStore> store_;
  std::unique_ptr<MapRegistry> registry_;
  std::shared_ptr<OpenMap> session_;
  Things things_;
};

/// A row of the table.
struct EditCost {
  std::string edit;
  std::int64_t num_voxels = 0;
  double made_ms = 0;    ///< on the map's writer
  double stored_ms = 0;  ///< from the call to the answer, with a full sync
  double rest_ms = 0;    ///< from the answer until nothing is left to be stored, with a full sync
  double undone_ms = 0;  ///< as stored_ms, of its undo
};

Result<EditCost> Measure(const MeasuredEdit& edit, int repetitions, EditedMap& map) {
  std::vector<double> made_ms, stored_ms, rest_ms, undone_ms;
  for (int n = 0; n < repetitions; ++n) {
    if (!edit.before.empty()) DHPMAP_RETURN_IF_ERROR(map.Do(map.ChangeOf(edit.before)));
    DHPMAP_RETURN_IF_ERROR(map.Rest());
    const auto begin = EditClock::now();
    DHPMAP_RETURN_IF_ERROR(map.Do([&, change = map.ChangeOf(edit.edits)](Map& edited) {
      const auto turn = EditClock::now();
      auto made = change(edited);
      made_ms.push_back(MsSince(turn));
      return made;
    }));
    stored_ms.push_back(MsSince(begin));
    const auto answered = EditClock::now();
    DHPMAP_RETURN_IF_ERROR(map.Rest());
    rest_ms.push_back(MsSince(answered));
    const auto undo = EditClock::now();
    DHPMAP_RETURN_IF_ERROR(map.Undo(1));
    undone_ms.push_back(MsSince(undo));
    if (!edit.before.empty()) DHPMAP_RETURN_IF_ERROR(map.Undo(1));
  }
  return EditCost{edit.name,           map.things().num_voxels, MedianOf(made_ms),
                  MedianOf(stored_ms), MedianOf(rest_ms),       MedianOf(undone_ms)};
}

Status MeasureSize(double num_voxels, const EditBenchOptions& options, std::vector<EditCost>& costs) {
  const fs::path parent = options.scratch.empty() ? fs::temp_directory_path() : fs::path(options.scratch);
  const fs::path folder = parent / ("edit-bench-" + std::to_string(DrawHistoryId()));
  fs::create_directories(folder);
  Status status;
  {
    EditedMap map(folder);
    status = map.Begin(num_voxels);
    if (status.ok()) {
      for (const MeasuredEdit& edit : EditsOf(map.things())) {
        auto cost = Measure(edit, options.repetitions, map);
        if (!cost.ok()) {
          status = cost.status();
          break;
        }
        costs.push_back(*std::move(cost));
      }
    }
  }
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return status;
}

void PrintTable(const std::vector<EditCost>& costs) {
  std::printf("%-20s %10s %10s %10s %10s %10s\n", "edit", "voxels", "ms", "stored ms", "rest ms", "undo ms");
  for (const EditCost& cost : costs) {
    std::printf("%-20s %10lld %10.2f %10.2f %10.2f %10.2f\n", cost.edit.c_str(),
                static_cast<long long>(cost.num_voxels), cost.made_ms, cost.stored_ms, cost.rest_ms, cost.undone_ms);
  }
}

void PrintJson(const std::vector<EditCost>& costs) {
  nlohmann::json rows = nlohmann::json::array();
  for (const EditCost& cost : costs) {
    rows.push_back({{"edit", cost.edit},
                    {"voxels", cost.num_voxels},
                    {"ms", cost.made_ms},
                    {"stored_ms", cost.stored_ms},
                    {"rest_ms", cost.rest_ms},
                    {"undo_ms", cost.undone_ms}});
  }
  std::printf("%s\n", rows.dump(2).c_str());
}

}  // namespace

Status RunEditBench(const EditBenchOptions& options) {
  std::vector<EditCost> costs;
  for (const double num_voxels : options.num_voxels) DHPMAP_RETURN_IF_ERROR(MeasureSize(num_voxels, options, costs));
  if (options.json) PrintJson(costs);
  else PrintTable(costs);
  return Status::Ok();
}

}  // namespace dhpmap::bench
