// SPDX-License-Identifier: BSD-3-Clause
// Revisions and ids that somebody may have seen are never given out again.
#include "tests/unit/storage/any_store_fixture.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::SqliteStoreTest;

/// With several servers the next owner of a map skips its numbers, so maps are loaded before their numbers are read.
class NumbersTest : public AnyStoreTest {};
DHPMAP_ON_STORES_THAT_KEEP(NumbersTest);

TEST_P(NumbersTest, AfterAnUncleanEndAMapGoesOnAboveItsMarksAndTheGapIsNoted) {
  const auto map = CreateSample("house");
  const auto other = CreateSample("other");
  ASSERT_EQ(map->info().revision, 1);
  ASSERT_TRUE(store_->Reserve("house", {.revision = 500, .next_submap_id = SubmapId(70)}).ok());
  ExpectStored(*map->published());  // nothing has changed for those who read now

  Open();
  const auto loaded = store_->LoadMap("house");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  const auto stored = store_->GetMap("house");
  ASSERT_TRUE(stored.ok()) << stored.status().ToString();
  EXPECT_EQ(stored->info.revision, 501);
  EXPECT_EQ(stored->info.next_submap_id, SubmapId(70));
  EXPECT_EQ(Query("SELECT first_revision FROM lost_revisions"), 2);
  EXPECT_EQ(Query("SELECT last_revision FROM lost_revisions"), 500);
  EXPECT_EQ(stored->lost_revisions, (LostRevisions{{2, 500}}));
  EXPECT_EQ(store_->GetMap("other")->lost_revisions, LostRevisions());
  ExpectStored(*other->published());

  // It goes on from there, and opening it once more leaves it as it is.
  Map next(*loaded);
  generator_.AddSubmap(next, 2);
  EXPECT_EQ(next.submaps().back()->id(), SubmapId(70));
  ASSERT_TRUE(store_->Commit(**loaded, *next.Publish(9), Durability::kNormal).ok());
  Open();
  ExpectStored(*next.published());
  EXPECT_EQ(next.info().revision, 502);
  EXPECT_EQ(Query("SELECT count(*) FROM lost_revisions"), 1);
}

TEST_P(NumbersTest, ACleanEndLeavesNoGap) {
  const auto map = CreateSample("house");
  ASSERT_TRUE(store_->Reserve("house", {.revision = 500, .next_submap_id = SubmapId(70)}).ok());
  const auto before = map->published();
  generator_.AddSubmap(*map, 1);
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(8), Durability::kFull).ok());
  ASSERT_TRUE(store_->Reserve("house", {.revision = 2, .next_submap_id = map->info().next_submap_id}).ok());
  Open();
  ExpectStored(*map->published());
  EXPECT_EQ(Query("SELECT count(*) FROM lost_revisions"), 0);
}

TEST_P(NumbersTest, IdsAloneGoOnAboveTheirMarkToo) {
  CreateSample("house");
  ASSERT_TRUE(store_->Reserve("house", {.revision = 1, .next_submap_id = SubmapId(70)}).ok());
  Open();
  ASSERT_TRUE(store_->LoadMap("house").ok());
  EXPECT_EQ(store_->GetMap("house")->info.next_submap_id, SubmapId(70));
  EXPECT_EQ(Query("SELECT count(*) FROM lost_revisions"), 0);
}

TEST_P(NumbersTest, MarksAreNeverBelowWhatIsStored) {
  const auto map = CreateSample("house");
  ASSERT_TRUE(store_->Reserve("house", {}).ok());
  EXPECT_EQ(Query("SELECT revision_mark FROM maps"), 1);
  const auto before = map->published();
  generator_.AddSubmap(*map, 1);
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(8), Durability::kNormal).ok());
  EXPECT_EQ(Query("SELECT revision_mark FROM maps"), 2);
  Open();
  ExpectStored(*map->published());
}

TEST_P(NumbersTest, ReservingForNoMapOrADamagedOneIsATypedError) {
  EXPECT_EQ(store_->Reserve("ghost", {.revision = 5, .next_submap_id = {}}).code(), StatusCode::kNotFound);
  CreateSample("house");
  store_ = nullptr;
  Tamper("UPDATE maps SET revision_mark = 900");
  Open();
  EXPECT_EQ(store_->GetMap("house").status().code(), StatusCode::kDataLoss);
  EXPECT_EQ(store_->Reserve("house", {.revision = 5, .next_submap_id = {}}).code(), StatusCode::kDataLoss);
  EXPECT_EQ(Query("SELECT revision FROM maps"), 1) << "a damaged map is left alone";
}

TEST_F(SqliteStoreTest, AStoreThatIsOpenForReadingReservesNoNumbers) {
  Open();
  CreateSample("house");
  Open(true);
  EXPECT_EQ(store_->Reserve("house", {}).reason(), Reason("NOT_WRITABLE"));
}

}  // namespace
}  // namespace dhpmap
