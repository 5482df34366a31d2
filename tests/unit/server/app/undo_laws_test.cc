// SPDX-License-Identifier: BSD-3-Clause
// An undo preserves tracks, merged objects and spheres, whatever happened in between.
#include <string>

#include "tests/unit/server/app/edit_undo_fixture.h"
#include "tests/unit/server/app/map_laws.h"

namespace dhpmap {
namespace {

using testing::SpheresHoldWhatWasObserved;

class UndoLaws : public testing::EditUndoTest {
 protected:
  /// A frame of a session that uses this track id for the object.
  void TrackAs(SubmapId id, const std::string& session, std::uint32_t track_id) {
    const auto before = map->published();
    SubmapInfo& info = map->FindMutable(id)->mutable_info();
    info.track_id = track_id;
    info.sightings.SetTrack(session, track_id);
    ASSERT_TRUE(store->Commit(*before, *map->Publish(++time_ns), Durability::kNormal).ok());
  }
  const SubmapInfo& InfoOf(SubmapId id) { return map->Find(id)->info(); }
};

TEST_P(UndoLaws, UndoingAMergeIntoALaterObjectRestoresTheTrack) {
  TrackAs(SubmapId(1), "robot", 7);
  ASSERT_TRUE(Do({On(2, MergeEdit{{SubmapId(1)}})}).ok());
  ASSERT_EQ(InfoOf(SubmapId(2)).sightings.TrackOf("robot"), 7u);
  ASSERT_TRUE(Undo({}).ok());
  EXPECT_EQ(InfoOf(SubmapId(1)).sightings.TrackOf("robot"), 7u);
  EXPECT_EQ(InfoOf(SubmapId(1)).track_id, 7u);
  EXPECT_EQ(InfoOf(SubmapId(2)).sightings.TrackOf("robot"), 0u);
  EXPECT_EQ(InfoOf(SubmapId(2)).track_id, 0u);
}

TEST_P(UndoLaws, UndoingADeletionRestoresTheTrackBesideAnotherSessions) {
  TrackAs(SubmapId(1), "first", 7);
  TrackAs(SubmapId(2), "second", 7);
  ASSERT_TRUE(Do({On(1, DeleteEdit{})}).ok());
  ASSERT_TRUE(Undo({}).ok());
  EXPECT_EQ(InfoOf(SubmapId(1)).sightings.TrackOf("first"), 7u);
  EXPECT_EQ(InfoOf(SubmapId(1)).track_id, 7u);
}

TEST_P(UndoLaws, ADeletionOfAnObjectMergedSinceIsNotUndone) {
  ASSERT_TRUE(Do({On(1, DeleteEdit{})}).ok());
  const std::int64_t deletion = map->info().revision;
  const Status back = Commit("anna", [this](Map& edited) { return UndeleteSubmap(SubmapId(1), *store, edited); });
  ASSERT_TRUE(back.ok()) << back.ToString();
  ASSERT_TRUE(Do({On(2, MergeEdit{{SubmapId(1)}})}).ok());
  const Status undone = Undo({.edit = deletion});
  EXPECT_EQ(undone.reason(), Reason("UNDO_CONFLICT")) << undone.ToString();
  EXPECT_EQ(map->Find(SubmapId(1)), nullptr) << "it would be there twice";
  EXPECT_EQ(map->info().merged.Into(SubmapId(1)), SubmapId(2));
}

TEST_P(UndoLaws, RedoingAClearKeepsLaterObservationsInTheSphere) {
  Observe(SubmapId(1), {10, 0, 0});
  const Eigen::AlignedBox3d end(block_m() * Eigen::Vector3d(9.5, -1, -1), block_m() * Eigen::Vector3d(11.5, 1, 1));
  ASSERT_TRUE(Do({On(1, ClearEdit{end, {}})}).ok());
  ASSERT_EQ(map->Find(SubmapId(1))->blocks().size(), 6u);
  ASSERT_TRUE(Undo({}).ok());
  Observe(SubmapId(1), {7, 0, 0});  // between both ends: the sphere stays as it is
  ASSERT_TRUE(Redo().ok());
  ASSERT_EQ(map->Find(SubmapId(1))->blocks().size(), 7u);
  EXPECT_TRUE(SpheresHoldWhatWasObserved(*map->published()));
  ExpectIntact();
}

INSTANTIATE_TEST_SUITE_P(Stores, UndoLaws, ::testing::Values(testing::StoreKind::kMemory, testing::StoreKind::kSqlite),
                         [](const auto& kind) {
                           return kind.param == testing::StoreKind::kMemory ? "Memory" : "Sqlite";
                         });

}  // namespace
}  // namespace dhpmap
