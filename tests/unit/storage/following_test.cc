// SPDX-License-Identifier: BSD-3-Clause
// A process that follows what another one commits has, at every revision, the state that loading gives.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "storage/postgres/following/later_state.h"
#include "storage/postgres/pool.h"
#include "storage/postgres/tiles/commit_places.h"
#include "storage/postgres_store.h"
#include "tests/support/eventually.h"
#include "tests/support/map_equality.h"
#include "tests/support/postgres_cluster.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::ExpectSameMap;
using testing::MapGenerator;
using testing::MapsAreEqual;
using testing::PostgresCluster;

class FollowingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (PostgresCluster::Get() == nullptr) GTEST_SKIP() << PostgresCluster::WhyThereIsNone();
    schema_ = PostgresCluster::Get()->NewSchema();
    owner_ = Open();
    reader_ = Open();
    pool_ = std::make_unique<postgres::Pool>(
        postgres::ConnectionOptions{.url = PostgresCluster::Get()->Url(), .schema = schema_}, 1);
    map_ = std::make_unique<Map>(generator_.Info("house"));
    for (int n = 0; n < 4; ++n) generator_.AddSubmap(*map_, 8);
    ASSERT_TRUE(owner_->CreateMap(*map_->Publish(1)).ok());
    Follow();
  }
  std::unique_ptr<MapStore> Open() {
    auto opened = OpenPostgresStore(PostgresCluster::Get()->Url(), {.schema = schema_, .max_connections = 2});
    EXPECT_TRUE(opened.ok()) << opened.status().ToString();
    return opened.ok() ? std::move(opened).value() : nullptr;
  }
  void Follow() {
    auto read = reader_->LoadToRead("house");
    ASSERT_TRUE(read.ok()) << read.status().ToString();
    followed_ = std::move(read).value();
  }

  /// Some change, by frames or as an edit.
  void Change(bool is_edit) {
    const auto before = map_->published();
    const StateMarks marks(*before, nullptr, lacks_left_);
    const bool moves = is_edit && !lacks_left_ && generator_.Below(2) == 0;
    if (moves) MoveSome();
    else generator_.Change(*map_);
    const auto after = map_->Publish(++time_ns_);
    const bool as_edit = is_edit && !lacks_left_;
    const EditRecord edit{.entry = {after->revision(), time_ns_, {}, {}}, .answer = "", .before = before};
    const Status done =
        as_edit ? owner_->CommitEdit(marks, *after, edit) : owner_->Commit(marks, *after, Durability::kNormal);
    ASSERT_TRUE(done.ok()) << done.ToString();
    lacks_left_ = as_edit && after->leaving().has_value();
  }
  /// An object goes; where it was is written by the next commit.
  void MoveSome() {
    const auto& submaps = map_->submaps();
    const SubmapId id = submaps.back()->id();
    if (id == kUnknownSubmap) return generator_.Change(*map_);
    Submap& submap = *map_->FindMutable(id);
    submap.mutable_info().T_map_submap.translation().x() += 3;
    submap.mutable_info().is_placed = true;
    map_->NoteLeaving(id);
  }
  /// What an edit has left, at the same revision.
  void WriteLeft() {
    const auto state = map_->published();
    ASSERT_TRUE(owner_->Commit({*state, nullptr, true}, *state, Durability::kNormal).ok());
    lacks_left_ = false;
  }

  /// By what was committed since alone.
  void GoOn() {
    auto later = pool_->Read<std::optional<StateToRead>>([this](postgres::Connection& connection) {
      ThreadPool threads(2);
      return postgres::ReadLaterState(connection, followed_, threads);
    });
    ASSERT_TRUE(later.ok()) << later.status().ToString();
    ASSERT_TRUE(later->has_value()) << "it was to be read anew";
    followed_ = **std::move(later);
  }
  std::int64_t Number(const std::string& sql) {
    const auto number = pool_->Read<std::int64_t>([&](postgres::Connection& connection) -> Result<std::int64_t> {
      DHPMAP_ASSIGN_OR_RETURN(postgres::Answer answer, connection.Query({&sql}, "count"));
      return answer.Next() ? answer.Int() : -1;
    });
    EXPECT_TRUE(number.ok()) << number.status().ToString();
    return number.ok() ? *number : -1;
  }
  /// As a server does.
  void GoOnOrReadAnew() {
    auto later = reader_->ReadSince(followed_);
    ASSERT_TRUE(later.ok()) << later.status().ToString();
    followed_ = std::move(later).value();
  }
  /// It is the state that loading gives, bit for bit, and that was committed.
  void ExpectFollowed() {
    const auto loaded = reader_->LoadToRead("house");
    ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
    EXPECT_TRUE(MapsAreEqual(*loaded->snapshot, *followed_.snapshot));
    EXPECT_EQ(loaded->snapshot->leaving(), followed_.snapshot->leaving());
    ExpectSameMap(*map_->published(), *followed_.snapshot);
  }

  MapGenerator generator_{43};
  std::string schema_;
  std::unique_ptr<MapStore> owner_, reader_;
  std::unique_ptr<postgres::Pool> pool_;
  std::unique_ptr<Map> map_;
  StateToRead followed_;
  std::int64_t time_ns_ = 1;
  bool lacks_left_ = false;
};

TEST_F(FollowingTest, EveryRevisionIsTheOneThatLoadingGives) {
  for (int n = 0; n < 60; ++n) {
    SCOPED_TRACE("change " + std::to_string(n));
    Change(n % 4 == 3);
    GoOn();
    ExpectFollowed();
    if (HasFailure()) return;
    if (lacks_left_ && n % 8 == 3) {
      WriteLeft();
      GoOn();
      ExpectFollowed();
    }
  }
}

TEST_F(FollowingTest, SeveralCommitsAreFollowedInOneStep) {
  for (int n = 0; n < 12; ++n) {
    SCOPED_TRACE("step " + std::to_string(n));
    for (int commits = 1 + generator_.Below(6); commits > 0; --commits) Change(generator_.Below(3) == 0);
    GoOn();
    ExpectFollowed();
    if (HasFailure()) return;
  }
}

TEST_F(FollowingTest, AnObjectThatWasRemovedAndPutBackHasNoOldTiles) {
  const SubmapId id(2);
  const SubmapInfo info = map_->Find(id)->info();
  const auto commit = [&] {
    const auto before = map_->published();
    ASSERT_TRUE(owner_->Commit(*before, *map_->Publish(++time_ns_), Durability::kNormal).ok());
  };
  ASSERT_TRUE(map_->Remove(id));
  commit();
  Submap& back = map_->PutBack(info);
  generator_.AddBlocks(back, 1);
  commit();
  GoOn();
  ExpectFollowed();
}

TEST_F(FollowingTest, WhatHasNotChangedIsShared) {
  const StateToRead before = followed_;
  GoOn();
  EXPECT_EQ(followed_.snapshot, before.snapshot) << "nothing was committed";
  Submap& one = *map_->FindMutable(SubmapId(2));
  one.mutable_info().display_name = "renamed";
  const auto state = map_->published();
  ASSERT_TRUE(owner_->Commit(*state, *map_->Publish(2), Durability::kNormal).ok());
  GoOn();
  ExpectFollowed();
  for (const auto& submap : followed_.snapshot->submaps()) {
    const Submap* old = before.snapshot->Find(submap->id());
    ASSERT_NE(old, nullptr);
    EXPECT_EQ(submap.get() == old, submap->id() != SubmapId(2));
    ASSERT_EQ(submap->blocks().tiles().size(), old->blocks().tiles().size());
    for (const TileEntry& tile : submap->blocks().tiles()) {
      EXPECT_EQ(tile.tile, old->blocks().FindTile(tile.index)->tile);
    }
  }
  EXPECT_EQ(followed_.snapshot->free_space(), before.snapshot->free_space());
  EXPECT_EQ(followed_.snapshot->info().label_set, before.snapshot->info().label_set);
}

TEST_F(FollowingTest, FollowingTakesNoMap) {
  for (int n = 0; n < 3; ++n) {
    Change(false);
    GoOn();
  }
  Change(true);
  EXPECT_TRUE(owner_->Reserve("house", {map_->info().revision + 9, SubmapId(90)}).ok());
  GoOn();
  ExpectFollowed();
}

TEST_F(FollowingTest, AnotherMapOfTheSameNameIsLoadedAgain) {
  ASSERT_TRUE(owner_->DeleteMap("house").ok());
  EXPECT_EQ(reader_->ReadSince(followed_).status().code(), StatusCode::kNotFound);
  map_ = std::make_unique<Map>(generator_.Info("house"));
  generator_.AddSubmap(*map_, 3);
  ASSERT_TRUE(owner_->CreateMap(*map_->Publish(7)).ok());
  GoOnOrReadAnew();
  ExpectFollowed();
}

TEST_F(FollowingTest, ACopyTooFarBehindIsLoadedAgain) {
  const auto run = [this](const std::string& sql) {
    const auto done = pool_->Read<bool>([&](postgres::Connection& connection) -> Result<bool> {
      DHPMAP_RETURN_IF_ERROR(connection.Execute(sql, "change the test's rows"));
      return true;
    });
    ASSERT_TRUE(done.ok()) << done.status().ToString();
  };
  Change(false);
  followed_.commit_id -= postgres::CommitPlaces::kNumKept;
  GoOnOrReadAnew();
  ExpectFollowed();
  Change(false);
  run("DELETE FROM commit_places");
  Change(false);
  GoOnOrReadAnew();  // sums show that something is missing
  ExpectFollowed();
}

TEST_F(FollowingTest, PlacesTakeATwentiethOfAPercentOfWhatACommitWrites) {
  const std::int64_t bytes_before = Number("SELECT sum(octet_length(blob)) FROM tile_blobs");
  const auto before = map_->published();
  generator_.AddSubmap(*map_, 150);
  ASSERT_TRUE(owner_->Commit(*before, *map_->Publish(2), Durability::kNormal).ok());
  constexpr std::int64_t kRow_bytes = 60;  // its header, keys, and entry in the index
  const std::int64_t places = Number("SELECT sum(octet_length(places)) FROM commit_places") + kRow_bytes;
  const std::int64_t blobs = Number("SELECT sum(octet_length(blob)) FROM tile_blobs") - bytes_before;
  EXPECT_GT(places, kRow_bytes + 10);
  EXPECT_LE(2000 * places, blobs);
}

TEST_F(FollowingTest, PlacesOfOldCommitsAreForgotten) {
  const auto count = [this] { return Number("SELECT count(*) FROM commit_places"); };
  constexpr int kNumMore = 130;
  for (int n = 0; n < postgres::CommitPlaces::kNumKept + kNumMore; ++n) {
    const auto before = map_->published();
    map_->mutable_info().num_frames += 1;
    ASSERT_TRUE(owner_->Commit(*before, *map_->Publish(2), Durability::kNormal).ok());
  }
  EXPECT_GE(count(), postgres::CommitPlaces::kNumKept);
  EXPECT_LT(count(), postgres::CommitPlaces::kNumKept + 61);
  ASSERT_TRUE(owner_->DeleteMap("house").ok());
  EXPECT_TRUE(testing::Eventually([&] { return count() == 0; }));
}

TEST(CommitPlaces, AreReadAsTheyWereWritten) {
  using postgres::CommitPlaces;
  CommitPlaces places;
  places.AddRow(3);
  places.AddTile(3, {-5, 1 << 30, -(1 << 30)}, 1);
  places.AddTile(3, {-5, 1 << 30, -(1 << 30)}, 4);
  places.AddTile(-1, {0, 0, 7}, 3);
  places.Empty(8);
  CommitPlaces read;
  ASSERT_TRUE(read.Add(places.Encode()).ok());
  ASSERT_EQ(read.owners().size(), 3u);
  EXPECT_TRUE(read.owners().at(3).is_row_changed);
  EXPECT_EQ(read.owners().at(3).tiles, places.owners().at(3).tiles);
  EXPECT_EQ(read.owners().at(-1).tiles, places.owners().at(-1).tiles);
  EXPECT_TRUE(read.owners().at(8).is_emptied);
  EXPECT_EQ(read.NumTileRows(), 3u);
  CommitPlaces later;
  later.Empty(3);
  ASSERT_TRUE(read.Add(later.Encode()).ok());
  EXPECT_TRUE(read.owners().at(3).tiles.empty()) << "what was there before is gone";
  EXPECT_TRUE(read.owners().at(3).is_row_changed);
}

TEST(CommitPlaces, DamageIsFound) {
  postgres::CommitPlaces places;
  for (int n = 0; n < 20; ++n) places.AddTile(n / 5, {n, -n, 3 * n}, n % 3);
  const Bytes bytes = places.Encode();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Bytes flipped = bytes;
    flipped[i] ^= 0x10;
    EXPECT_EQ(postgres::CommitPlaces().Add(flipped).code(), StatusCode::kDataLoss) << i;
    EXPECT_EQ(postgres::CommitPlaces().Add(ByteView(bytes).first(i)).code(), StatusCode::kDataLoss) << i;
  }
}

}  // namespace
}  // namespace dhpmap
