// SPDX-License-Identifier: BSD-3-Clause
// Laws of undo and redo, on what the store holds.
#include "server/app/edit_undo.h"

#include <gtest/gtest.h>

#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "server/app/edit_list.h"
#include "server/app/edit_summary.h"
#include "tests/support/scenes.h"
#include "tests/unit/storage/map_text.h"

namespace dhpmap {
namespace {

using testing::TempDir;

std::string_view ReasonOf(const Status& status) { return status.reason().name(); }

/// All of a map but revisions, the time of the last one, and the next id.
std::string TextWithoutNumbers(const MapSnapshot& map) {
  static const std::regex kNumbers("(revision|next_submap_id|update_time_ns) [0-9]+");
  std::string text = std::regex_replace(testing::TextOf(map), kNumbers, "");
  for (const MergedId& entry : map.info().merged.list()) {
    text += "merged " + std::to_string(entry.merged.value) + " into " + std::to_string(entry.into.value) + "\n";
  }
  for (const ObjectPair& pair : map.info().pairs.pairs()) {
    text += "pair " + std::to_string(pair.first.value) + " " + std::to_string(pair.second.value) + " verdict " +
            std::to_string(static_cast<int>(pair.verdict)) + " evidence " + std::to_string(pair.evidence) + "\n";
  }
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

/// What differs, of two texts of maps: empty if nothing does.
std::string Difference(const std::string& a, const std::string& b) {
  std::istringstream lines_of_a(a), lines_of_b(b);
  std::string x, y, object;
  for (bool has_x = true, has_y = true; has_x || has_y;) {
    has_x = static_cast<bool>(std::getline(lines_of_a, x));
    has_y = static_cast<bool>(std::getline(lines_of_b, y));
    if (x.starts_with("submap")) object = x;
    if (has_x != has_y || (has_x && x != y)) return "of " + object + ": '" + x + "' against '" + y + "'";
  }
  return {};
}

enum class StoreKind { kMemory, kSqlite };

/// A stored map with things that are rows of blocks along x, each at a y of its own.
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
    submap.AddClassObservations(ClassId(1), 6 * kBlockVoxels);
    submap.UpdateBoundingSphere();
  }
  [[nodiscard]] double block_m() const { return kBlockSide * map->info().config.voxel_size_m; }

  /// Runs what an edit does, as a session does.
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

TEST_P(EditUndoTest, EveryEditWithItsUndoLeavesTheMapAsItWas) {
  const auto edits = [this] {
    return std::vector<std::pair<std::string, std::vector<Edit>>>{
        {"move", {Move(1, 3)}},
        {"rename", {Rename(1, "lamp")}},
        {"relabel", {Relabel(1, 2)}},
        {"clone", {On(1, CloneEdit{})}},
        {"delete", {On(1, DeleteEdit{})}},
        {"merge", {On(1, MergeEdit{{SubmapId(2), SubmapId(3)}})}},
        {"split", {Split(2, 3)}},
        {"clear", {Clear(2, 1.2)}},
        {"clear all of it", {Clear(3, 30)}},
        {"absent", {On(1, PresenceEdit{Presence::kAbsent})}},
        {"present", {On(1, PresenceEdit{Presence::kPresent})}},
        {"a list", {Move(1, 2), On(2, MergeEdit{{SubmapId(3)}}), Split(2, 2), On(4, DeleteEdit{}), Rename(5, "a")}}};
  }();
  const std::string before = Stored();
  for (const auto& [name, list] : edits) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(Do(list).ok());
    const std::string after = Stored();
    EXPECT_NE(Difference(after, before), "");
    const Status undone = Undo({});
    ASSERT_TRUE(undone.ok()) << undone.ToString();
    ASSERT_EQ(Difference(Stored(), before), "");
    Restart();
    const Status redone = Redo();
    ASSERT_TRUE(redone.ok()) << redone.ToString();
    ASSERT_EQ(Difference(Stored(), after), "");
    ASSERT_TRUE(Undo({}).ok());
    ASSERT_EQ(Difference(Stored(), before), "");
    ASSERT_EQ(Difference(TextWithoutNumbers(*map->published()), before), "") << "in memory, too";
    ExpectIntact();
  }
}

TEST_P(EditUndoTest, RandomEditsUndosRedosAndRestartsAgreeWithAStackOfStates) {
  std::mt19937 random(11);
  std::vector<std::string> done, undone;  // states to go back to, and to go on to
  int num_undone = 0, num_redone = 0;
  for (int step = 0; step < 150; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const std::string before = Stored();
    const std::uint32_t dice = random() % 16;
    const auto& submaps = map->submaps();
    const auto any = [&] { return submaps.size() > 1 ? submaps[1 + random() % (submaps.size() - 1)]->id().value : 1u; };
    if (dice < 5) {
      const std::size_t count = 1 + random() % 3;
      const Status status = Undo({.count = count});
      if (done.size() < count) {
        ASSERT_EQ(ReasonOf(status), "NOTHING_TO_UNDO");
        ASSERT_EQ(Difference(Stored(), before), "");
        continue;
      }
      ASSERT_TRUE(status.ok()) << status.ToString();
      std::string now = before;
      for (std::size_t n = 0; n < count; ++n) {
        undone.push_back(now);
        now = done.back();
        done.pop_back();
      }
      ASSERT_EQ(Difference(Stored(), now), "");
      ++num_undone;
    } else if (dice < 9) {
      const Status status = Redo();
      if (undone.empty()) {
        ASSERT_EQ(ReasonOf(status), "NOTHING_TO_REDO");
        continue;
      }
      ASSERT_TRUE(status.ok()) << status.ToString();
      done.push_back(before);
      ASSERT_EQ(Difference(Stored(), undone.back()), "");
      undone.pop_back();
      ++num_redone;
    } else if (dice == 9) {
      Restart();
      ASSERT_EQ(Difference(Stored(), before), "");
    } else {
      const std::uint32_t id = any(), other = any();
      std::vector<Edit> list;
      switch (random() % 9) {
        case 0: list = {Move(id, 1 + random() % 5)}; break;
        case 1: list = {Rename(id, "name " + std::to_string(step))}; break;
        case 2: list = {Relabel(id, static_cast<std::uint16_t>(1 + random() % 3))}; break;
        case 3: list = {On(id, CloneEdit{})}; break;
        case 4: list = {On(id, DeleteEdit{})}; break;
        case 5: list = {On(id, MergeEdit{{SubmapId(other)}})}; break;
        case 6: list = {Split(id, 1 + random() % 5)}; break;
        case 7: list = {Clear(random() % 6, 0.3 + 0.1 * (random() % 8))}; break;
        default: list = {On(id, PresenceEdit{random() % 2 == 0 ? Presence::kAbsent : Presence::kPresent})}; break;
      }
      const std::int64_t revision = map->info().revision;
      const Status status = Do(list);
      if (!status.ok() || map->info().revision == revision) {
        ASSERT_EQ(Difference(Stored(), before), "");
        continue;
      }
      done.push_back(before);
      undone.clear();
    }
  }
  EXPECT_GT(num_undone, 15);
  EXPECT_GT(num_redone, 10);
  ExpectIntact();
}

TEST_P(EditUndoTest, WithFramesBetweenItIsDoneWhollyOrNotAtAll) {
  std::mt19937 random(23);
  int num_undone = 0, num_conflicts = 0;
  for (int step = 0; step < 150; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const auto& submaps = map->submaps();
    if (submaps.size() < 4) {
      ASSERT_TRUE(Do({On(submaps.back()->id().value, CloneEdit{})}, "ben").ok());
    }
    const std::uint32_t id = map->submaps()[1 + random() % (map->submaps().size() - 1)]->id().value;
    switch (random() % 6) {
      case 0:
        Observe(SubmapId(id), {static_cast<std::int32_t>(random() % 6), static_cast<std::int32_t>(id % 5), 0});
        break;
      case 1: (void)Do({Split(id, 1 + random() % 5)}); break;
      case 2: (void)Do({Move(id, 1 + random() % 5)}, "ben"); break;
      case 3: (void)Do({On(id, DeleteEdit{})}); break;
      default: {
        const std::string before = Stored();
        const auto log = *store->ListEdits("m", {.max_edits = 12});
        if (log.empty()) break;
        const LoggedEdit& edit = log[random() % log.size()];
        UndoRequest request{.kind = edit.is_undone ? EditKind::kRedo : EditKind::kUndo, .edit = edit.entry.revision};
        const Status status = Undo(request);
        if (status.ok()) {
          ++num_undone;
        } else {
          ASSERT_TRUE(ReasonOf(status) == "UNDO_CONFLICT" || ReasonOf(status) == "NOTHING_TO_UNDO")
              << status.ToString();
          if (ReasonOf(status) == "UNDO_CONFLICT") ++num_conflicts;
          ASSERT_EQ(Difference(Stored(), before), "");
        }
      }
    }
    ASSERT_EQ(Difference(TextWithoutNumbers(*map->published()), Stored()), "");
    for (const auto& submap : map->submaps()) {  // counts of classes are those of the voxels
      std::uint64_t in_row = 0, in_voxels = 0;
      for (const ClassTotal& total : submap->info().class_counts) in_row += total.count;
      for (const BlockEntry& entry : submap->blocks().entries()) {
        for (int v = 0; entry.labels != nullptr && v < kBlockVoxels; ++v) {
          for (const LabelCount& count : entry.labels->Get(v).classes) in_voxels += count.count;
        }
      }
      ASSERT_EQ(in_row, in_voxels) << "submap " << submap->id().value;
    }
  }
  EXPECT_GT(num_undone, 15);
  EXPECT_GT(num_conflicts, 5);
  ExpectIntact();
}

TEST_P(EditUndoTest, AnEditOfARowMeetsOnlyLaterEditsOfTheSameField) {
  ASSERT_TRUE(Do({Move(1, 2)}).ok());
  const std::int64_t moved = map->info().revision;
  ASSERT_TRUE(Do({Rename(1, "lamp")}, "ben").ok());
  Observe(SubmapId(1), {0, 0, 0});
  ASSERT_TRUE(Undo({.edit = moved}).ok()) << "a name and frames are other fields";
  EXPECT_EQ(map->Find(SubmapId(1))->info().display_name, "lamp");
  EXPECT_TRUE(map->Find(SubmapId(1))->info().T_map_submap.isApprox(Transform::Identity()));
  EXPECT_FALSE(map->Find(SubmapId(1))->info().is_placed);
  ASSERT_TRUE(Redo().ok());
  ASSERT_TRUE(Do({Move(1, 4)}, "ben").ok());
  const Status conflict = Undo({.edit = moved});
  EXPECT_EQ(conflict.code(), StatusCode::kAborted);
  EXPECT_EQ(ReasonOf(conflict), "UNDO_CONFLICT");
  std::map<std::string, std::string> metadata(conflict.metadata().begin(), conflict.metadata().end());
  EXPECT_EQ(metadata["instance_id"], "1");
  EXPECT_EQ(metadata["field"], "pose");
  EXPECT_EQ(metadata["edit"], std::to_string(moved));
}

TEST_P(EditUndoTest, AnEditOfVoxelsMeetsWhateverWroteToItsTiles) {
  ASSERT_TRUE(Do({Split(1, 3)}).ok());
  const std::int64_t split = map->info().revision;
  Observe(SubmapId(4), {0, 3, 0});  // of another object
  ASSERT_TRUE(Undo({.edit = split}).ok());
  ASSERT_TRUE(Redo().ok());
  Observe(SubmapId(1), {0, 0, 0});
  const Status conflict = Undo({.edit = split});
  EXPECT_EQ(ReasonOf(conflict), "UNDO_CONFLICT") << conflict.ToString();
}

TEST_P(EditUndoTest, EachAuthorHasHisOwnStackAndANewEditEndsTheRedo) {
  ASSERT_TRUE(Do({Rename(1, "a1")}, "anna").ok());
  ASSERT_TRUE(Do({Rename(2, "b1")}, "ben").ok());
  ASSERT_TRUE(Undo({.author = "anna"}).ok());
  EXPECT_EQ(map->Find(SubmapId(1))->info().display_name, "");
  EXPECT_EQ(map->Find(SubmapId(2))->info().display_name, "b1");
  ASSERT_TRUE(Do({Rename(2, "b2")}, "ben").ok());
  ASSERT_TRUE(Redo({.author = "anna"}).ok()) << "another's edit ends nothing";
  ASSERT_TRUE(Undo({.author = "anna"}).ok());
  ASSERT_TRUE(Do({Rename(3, "a2")}, "anna").ok());
  EXPECT_EQ(ReasonOf(Redo({.author = "anna"})), "NOTHING_TO_REDO");
  EXPECT_EQ(ReasonOf(Undo({.author = "nobody"})), "NOTHING_TO_UNDO");
  EXPECT_EQ(ReasonOf(Undo({.edit = 999})), "EDIT_NOT_FOUND");
  const std::int64_t last = map->info().revision;
  ASSERT_TRUE(Undo({.edit = last, .author = "ben"}).ok()) << "by its id, whoever made it";
  EXPECT_EQ(ReasonOf(Undo({.edit = last})), "NOTHING_TO_UNDO");
}

TEST_P(EditUndoTest, WhatIsNoLongerKeptSaysSo) {
  used_limits = {.max_histories = 2};
  BeginAnew(used_limits);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(Do({Split(static_cast<std::uint32_t>(i + 1), 3)}).ok());
  const auto log = *store->ListEdits("m", {});
  EXPECT_TRUE(log[0].is_kept && log[1].is_kept);
  EXPECT_FALSE(log[2].is_kept || log[3].is_kept);
  const Status lost = Undo({.edit = log[3].entry.revision});
  EXPECT_EQ(ReasonOf(lost), "UNDO_NOT_KEPT");
  std::map<std::string, std::string> metadata(lost.metadata().begin(), lost.metadata().end());
  EXPECT_EQ(metadata["oldest_edit"], std::to_string(log[1].entry.revision));
  EXPECT_EQ(ReasonOf(Undo({.count = 3})), "UNDO_NOT_KEPT") << "all or none";
  EXPECT_TRUE(Undo({.count = 2}).ok());
  ExpectIntact();
  if (GetParam() == StoreKind::kMemory) return;
  used_limits = {.max_history_bytes = 10};
  BeginAnew(used_limits);
  ASSERT_TRUE(Do({Split(1, 3)}).ok());
  EXPECT_EQ(ReasonOf(Undo({})), "UNDO_NOT_KEPT") << "alone larger than all that may be kept";
  ExpectIntact();
}

TEST_P(EditUndoTest, ADeletedObjectComesBackUnderItsId) {
  const std::string before = Stored();
  ASSERT_TRUE(Do({On(2, DeleteEdit{}), Rename(1, "lamp")}).ok());
  ASSERT_TRUE(Do({Rename(3, "sofa")}).ok());
  const auto undelete = [this](std::uint32_t id) {
    return Commit("ben", [&](Map& edited) { return UndeleteSubmap(SubmapId(id), *store, edited); });
  };
  EXPECT_EQ(ReasonOf(undelete(1)), "NOTHING_TO_UNDO");
  EXPECT_EQ(ReasonOf(undelete(77)), "SUBMAP_NOT_FOUND");
  ASSERT_TRUE(undelete(2).ok());
  EXPECT_EQ(map->Find(SubmapId(1))->info().display_name, "lamp") << "alone";
  ASSERT_NE(map->Find(SubmapId(2)), nullptr);
  ASSERT_TRUE(Do({Rename(1, "")}).ok());
  ASSERT_TRUE(Do({Rename(3, "")}).ok());
  // What was known of pairs of it is forgotten.
  const std::string now = Stored();
  EXPECT_EQ(Difference(now, std::regex_replace(before, std::regex("pair [^\n]*\n"), "")), "");
  ASSERT_TRUE(Do({On(4, MergeEdit{{SubmapId(5)}})}).ok());
  EXPECT_EQ(ReasonOf(undelete(5)), "MERGED_INTO");
  ExpectIntact();
}

INSTANTIATE_TEST_SUITE_P(Stores, EditUndoTest, ::testing::Values(StoreKind::kMemory, StoreKind::kSqlite),
                         [](const auto& kind) { return kind.param == StoreKind::kMemory ? "Memory" : "Sqlite"; });

}  // namespace
}  // namespace dhpmap
