// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/app/edits/edit_list.h"
#include "server/app/edits/edit_summary.h"
#include "server/app/edits/edit_undo.h"
#include "storage/sqlite_store.h"
#include "tests/support/scenes.h"
#include "tests/unit/storage/map_text.h"

namespace dhpmap::testing {

inline std::string_view ReasonOf(const Status& status) { return status.reason().name(); }

/// A map without its revisions, the time of the last one, and the next id.
inline std::string TextWithoutNumbers(const MapSnapshot& map) {
  static const std::regex kNumbers("(revision|next_submap_id|update_time_ns) [0-9]+");
  std::string text = std::regex_replace(testing::TextOf(map), kNumbers, "");
  std::map<TileIndex, std::string> vacated;
  for (const FreeTileEntry& entry : map.vacated()->tiles()) {
    std::string& line = vacated[entry.index];
    for (int cell = 0; cell < kTileBlocks; ++cell) {
      for (const std::uint64_t word : entry.tile->MaskOf(cell)) line += std::to_string(word) + " ";
    }
  }
  for (const auto& [index, line] : vacated) {
    text += "vacated " + std::to_string(index.x) + " " + std::to_string(index.y) + " " + std::to_string(index.z) + " " +
            line + "\n";
  }
  return text;
}

/// The difference of two maps' texts; empty if they are equal.
inline std::string Difference(const std::string& a, const std::string& b) {
  std::istringstream lines_of_a(a), lines_of_b(b);
  std::string x, y, object;
  for (bool has_x = true, has_y = true; has_x || has_y;) {
    has_x = static_cast<bool>(std::getline(lines_of_a, x));
    has_y = static_cast<bool>(std::getline(lines_of_b, y));
    if (x.starts_with("submap")) object = x;
    if (has_x == has_y && (!has_x || x == y)) continue;
    return object.append(": '").append(x).append("' against '").append(y).append("'");
  }
  return {};
}

enum class StoreKind { kMemory, kSqlite };

/// A stored map whose things are rows of blocks along x, each at its own y.
class EditUndoTest : public ::testing::TestWithParam<StoreKind> {
 protected:
  EditUndoTest() { Open({}); }

  void Open(const EditLogLimits& limits) {
    if (GetParam() == StoreKind::kMemory) {
      if (!store) store = MakeMemoryStore({}, limits);
    } else {
      store = nullptr;
      auto opened = OpenSqliteStore((folder.path() / "maps.db").string(), {.edits = limits});
      ASSERT_TRUE(opened.ok()) << opened.status().ToString();
      store = std::move(opened).value();
    }
    if (!store->GetMap("m").ok()) Create();
    map.emplace(*store->LoadMap("m"));
  }
  void BeginAnew(const EditLogLimits& limits) {
    store = nullptr;
    std::filesystem::remove(folder.path() / "maps.db");
    Open(limits);
  }
  void Restart() {
    if (GetParam() == StoreKind::kSqlite) Open(used_limits);
    else map.emplace(*store->LoadMap("m"));
  }

  void Create() {
    MapInfo info;
    info.name = "m";
    info.label_set = testing::MakeLabelSet(3, 1);
    Map made(info);
    for (int n = 0; n < 5; ++n) AddRow(made, n);
    made.mutable_info().pairs.AddEvidence(SubmapId(1), SubmapId(2), 7, -100, 100);
    ASSERT_TRUE(store->CreateMap(*made.Publish(1)).ok());
  }
  static void AddRow(Map& made, int n) {
    SubmapInfo info;
    info.panoptic = Panoptic::kThing;
    info.class_id = ClassId(1);
    info.voxel_size_m = made.info().config.voxel_size_m;
    info.truncation_m = made.info().config.truncation_m;
    info.activity = Activity::kInactive;
    Submap& submap = made.Create(std::move(info));
    for (int x = 0; x < 6; ++x) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        submap.MutableTsdf({x, n, 0}).weight[static_cast<std::size_t>(i)] = 1.0f + static_cast<float>(i % 3);
        submap.MutableLabels({x, n, 0}).AddObservation(i, ClassId(1));
      }
      if (x % 2 == 0) submap.MutableGone({x, n, 0}).Set(x + n, 2);
    }
    submap.AddClassObservations(ClassId(1), std::uint64_t{6} * kBlockVoxels);
    submap.UpdateBoundingSphere();
  }
  [[nodiscard]] double block_m() const { return kBlockSide * map->info().config.voxel_size_m; }

  /// Runs an edit as an open map does.
  template <typename Change>
  Status Commit(const std::string& author, Change&& change) {
    const auto before = map->published();
    Result<EditSummary> summary = change(*map);
    if (!summary.ok()) {
      map.emplace(before);
      return summary.status();
    }
    const auto after = map->Publish(++time_ns);
    if (after == before) return Status::Ok();  // nothing to store
    EditRecord record{.entry = {after->revision(), time_ns, {.author = author}, *summary}, .before = before};
    return store->CommitEdit(*before, *after, record);
  }
  Status Do(std::vector<Edit> edits, const std::string& author = "anna") {
    return Commit(author, [&](Map& edited) -> Result<EditSummary> {
      const EditList list{.edits = std::move(edits)};
      DHPMAP_ASSIGN_OR_RETURN(const auto results, ApplyEdits(list, edited));
      return SummaryOfList(list, results);
    });
  }
  Status Undo(UndoRequest request) {
    if (request.author.empty()) request.author = "anna";
    return Commit(request.author, [&](Map& edited) { return UndoEdits(request, *store, edited); });
  }
  Status Redo(UndoRequest request = {}) {
    request.kind = EditKind::kRedo;
    return Undo(request);
  }
  /// A frame that sees some voxels of an object.
  void Observe(SubmapId id, BlockIndex block) {
    const auto before = map->published();
    Submap* submap = map->FindMutable(id);
    ASSERT_NE(submap, nullptr);
    submap->MutableTsdf(block).weight[3] += 1;
    submap->MutableLabels(block).AddObservation(3, ClassId(2));
    submap->AddClassObservations(ClassId(2), 1);
    submap->UpdateBoundingSphere();
    ++submap->mutable_info().num_frames_observed;
    ASSERT_TRUE(store->Commit(*before, *map->Publish(++time_ns), Durability::kNormal).ok());
  }
  std::string Stored() { return TextWithoutNumbers(**store->LoadMap("m")); }
  void ExpectIntact() {
    const auto report = store->VerifyMap("m", false, {});
    ASSERT_TRUE(report.ok()) << report.status().ToString();
    for (const MapFault& fault : report->faults) ADD_FAILURE() << fault.place << " " << fault.what;
  }

  static Edit On(std::uint32_t id, decltype(Edit::action) action) {
    return {.target = SubmapId(id), .etag = {}, .action = std::move(action)};
  }
  static Edit Rename(std::uint32_t id, const std::string& name) {
    SubmapPatch patch;
    patch.display_name = name;
    return On(id, PatchEdit{patch});
  }
  static Edit Move(std::uint32_t id, double z_m) {
    SubmapPatch patch;
    patch.T_map_submap = Transform(Eigen::Translation3d(0, 0, z_m));
    return On(id, PatchEdit{patch});
  }
  static Edit Relabel(std::uint32_t id, std::uint16_t class_id) {
    SubmapPatch patch;
    patch.class_id = ClassId(class_id);
    return On(id, PatchEdit{patch});
  }
  static Edit Lock(std::uint32_t id, bool is_locked) {
    SubmapPatch patch;
    patch.is_locked = is_locked;
    return On(id, PatchEdit{patch});
  }
  static Edit KeepClear(const std::string& name, double radius_m) {
    return {.target = std::nullopt,
            .etag = {},
            .action = KeepClearEdit{{name, BoundingSphere{Eigen::Vector3d(1, 2, 3), radius_m}}}};
  }
  static Edit Lift(const std::string& name) { return {.target = std::nullopt, .etag = {}, .action = LiftEdit{name}}; }
  [[nodiscard]] Edit ClearAndKeep(const std::string& name) const {
    const Eigen::AlignedBox3d box_m(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(2 * block_m()));
    return {.target = std::nullopt, .etag = {}, .action = ClearEdit{box_m, {}, name}};
  }
  [[nodiscard]] Edit Split(std::uint32_t id, double x_blocks) const {
    return On(id, SplitEdit{SplitByPlane{Eigen::Vector3d(x_blocks * block_m(), 0, 0), Eigen::Vector3d(1, 0, 0)}});
  }
  [[nodiscard]] Edit Clear(double x_blocks, double radius_blocks) const {
    const Eigen::Vector3d center_m(x_blocks * block_m(), block_m(), block_m() / 2);
    return {.target = std::nullopt,
            .etag = {},
            .action = ClearEdit{BoundingSphere{center_m, radius_blocks * block_m()}, {}}};
  }

  TempDir folder;
  EditLogLimits used_limits;
  std::unique_ptr<MapStore> store;
  std::optional<Map> map;
  std::int64_t time_ns = 10;
};

}  // namespace dhpmap::testing
