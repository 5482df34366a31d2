// SPDX-License-Identifier: BSD-3-Clause
// The log of a map's edits, as both stores keep it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "storage/codec/edit_codec.h"
#include "storage/store.h"
#include "tests/support/scenes.h"
#include "tests/unit/storage/kept_store.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::MapGenerator;
using testing::StoreKind;

class EditsTest : public ::testing::TestWithParam<StoreKind> {
 protected:
  EditsTest() { Open(); }

  void Open(const EditLogLimits& limits = {}) {
    kept_.Open(store_, {.edits = limits, .passing_time_ns = [this] { return passed_ns_; }});
  }
  void SetUp() override { DHPMAP_SKIP_UNLESS_THERE(kept_); }
  void BeginAnew(const EditLogLimits& limits) {
    store_ = nullptr;
    kept_.BeginAnew();
    Open(limits);
  }
  Map Create(const std::string& name) {
    Map map(generator_.Info(name));
    generator_.AddSubmap(map, 4);
    EXPECT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
    return map;
  }
  /// Renames the first object, as an edit of these words.
  Status Rename(Map& map, EditSource source, std::int64_t time_ns = 5, const std::string& answer = "done",
                EditSummary summary = {}) {
    const auto before = map.published();
    map.FindMutable(SubmapId(1))->mutable_info().display_name = "name " + std::to_string(before->revision());
    const auto after = map.Publish(time_ns);
    const EditRecord record{.entry = {after->revision(), time_ns, std::move(source), std::move(summary)},
                            .answer = answer,
                            .before = before};
    return store_->CommitEdit(*before, *after, record);
  }
  std::vector<LoggedEdit> List(const EditQuery& query = {}) {
    auto edits = store_->ListEdits("a", query);
    EXPECT_TRUE(edits.ok()) << edits.status().ToString();
    return edits.ok() ? *edits : std::vector<LoggedEdit>();
  }

  testing::KeptStore kept_{GetParam()};
  MapGenerator generator_{7};
  std::int64_t passed_ns_ = 0;
  std::unique_ptr<MapStore> store_;
};

TEST_P(EditsTest, AnEditIsInTheLogWithTheStateThatItMade) {
  Map map = Create("a");
  const EditSummary summary{.steps = {{EditAction::kMove, SubmapId(1)}, {EditAction::kRename, SubmapId(1)}},
                            .changed = {SubmapId(1)},
                            .created = {SubmapId(2), SubmapId(4'000'000'000)},
                            .removed = {SubmapId(3)},
                            .num_voxels = 123'456'789'012};
  const EditSource source{.author = "Anna Ä", .request_id = "abc", .request_fingerprint = ~std::uint64_t{5}};
  ASSERT_TRUE(Rename(map, source, 1'700'000'000'000'000'000, std::string("x\0y", 3), summary).ok());
  for (int round = 0; round < 2; ++round) {
    const auto edits = List();
    ASSERT_EQ(edits.size(), 1u);
    EXPECT_EQ(edits[0].entry.revision, map.info().revision);
    EXPECT_EQ(edits[0].entry.time_ns, 1'700'000'000'000'000'000);
    EXPECT_EQ(edits[0].entry.source, source);
    EXPECT_EQ(edits[0].entry.summary, summary);
    EXPECT_FALSE(edits[0].is_undone);
    const auto answer = store_->FindAnswer("a", "abc");
    ASSERT_TRUE(answer.ok() && *answer) << answer.status().ToString();
    EXPECT_EQ((*answer)->answer, std::string("x\0y", 3));
    EXPECT_EQ((*answer)->request_fingerprint, source.request_fingerprint);
    EXPECT_EQ((*answer)->revision, map.info().revision);
    Open();  // and after a restart
  }
  EXPECT_FALSE(*store_->FindAnswer("a", "abd"));
  EXPECT_FALSE(*store_->FindAnswer("a", "")) << "no id is no request";
  EXPECT_EQ(store_->ListEdits("b", {}).status().code(), StatusCode::kNotFound);
}

TEST_P(EditsTest, ARestorationIsInTheLogWithTheRevisionThatItWentTo) {
  Map map = Create("a");
  const EditSummary restored{.steps = {{EditAction::kRestore, SubmapId()}}, .restored_revision = 5'000'000'017};
  const EditSummary older{.steps = {{EditAction::kRestore, SubmapId(1)}}, .changed = {SubmapId(1)}};
  ASSERT_TRUE(Rename(map, {}, 5, "", restored).ok());
  ASSERT_TRUE(Rename(map, {}, 6, "", older).ok());
  for (int round = 0; round < 2; ++round) {
    const auto edits = List();
    ASSERT_EQ(edits.size(), 2u);
    EXPECT_EQ(edits[0].entry.summary, older) << "of before the log told it";
    EXPECT_EQ(edits[1].entry.summary, restored);
    Open();  // and after a restart
  }
  if (GetParam() != StoreKind::kSqlite) return;
  const auto report = store_->VerifyMap("a", false, {});
  ASSERT_TRUE(report.ok()) << report.status().ToString();
  EXPECT_EQ(report->num_faults, 0);
}

TEST(EditSummaryCodec, WithoutARevisionToGoBackToItIsWrittenAsItEverWas) {
  const EditEntry older{.revision = 9, .summary = {.steps = {{EditAction::kRestore, SubmapId(1)}}}};
  EXPECT_EQ(EncodeEditSummary(older).front(), 0x71);
  EditEntry newer = older;
  newer.summary.restored_revision = 4;
  const Bytes blob = EncodeEditSummary(newer);
  EXPECT_EQ(blob.front(), 0x72);
  for (std::size_t size = 0; size < blob.size(); ++size) {
    EditEntry cut{.revision = 9};
    EXPECT_EQ(DecodeEditSummary(ByteView(blob).first(size), cut).code(), StatusCode::kDataLoss) << size;
  }
}

TEST_P(EditsTest, AStateThatIsNotStoredLeavesNothingInTheLog) {
  Map map = Create("a");
  const auto first = map.published();
  ASSERT_TRUE(Rename(map, {}).ok());
  Map stale(first);  // of a state that is not the stored one
  EXPECT_EQ(Rename(stale, {.request_id = "stale"}).code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(List().size(), 1u);
  EXPECT_FALSE(*store_->FindAnswer("a", "stale"));
}

TEST_P(EditsTest, TheNewestComeFirstAndAuthorsCanBeAskedFor) {
  Map map = Create("a");
  Map other = Create("b");
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(Rename(map, {.author = i % 2 == 0 ? "anna" : "ben"}).ok());
  ASSERT_TRUE(Rename(other, {.author = "anna"}).ok());
  std::vector<std::int64_t> revisions;
  for (const LoggedEdit& edit : List()) revisions.push_back(edit.entry.revision);
  EXPECT_EQ(revisions, (std::vector<std::int64_t>{7, 6, 5, 4, 3, 2}));
  revisions.clear();
  for (const LoggedEdit& edit : List({.before_revision = 6, .author = "anna", .max_edits = 1})) {
    revisions.push_back(edit.entry.revision);
  }
  EXPECT_EQ(revisions, (std::vector<std::int64_t>{4}));
  ASSERT_TRUE(store_->DeleteMap("a").ok());
  Map again = Create("a");
  EXPECT_TRUE(List().empty()) << "another map's of the same name";
}

TEST_P(EditsTest, WhatIsUndoneSaysSoUntilItIsDoneAgain) {
  Map map = Create("a");
  ASSERT_TRUE(Rename(map, {}).ok());
  ASSERT_TRUE(Rename(map, {}, 5, "", {.kind = EditKind::kUndo, .targets = {2}}).ok());
  EXPECT_TRUE(List()[1].is_undone);
  EXPECT_FALSE(List()[0].is_undone);
  ASSERT_TRUE(Rename(map, {}, 5, "", {.kind = EditKind::kRedo, .targets = {2}}).ok());
  EXPECT_FALSE(List()[2].is_undone);
}

TEST_P(EditsTest, WhatUndoesAnEditKnowsItsRowsAsTheyWere) {
  Map map = Create("a");
  const auto created = map.published();
  SubmapInfo& info = map.FindMutable(SubmapId(1))->mutable_info();
  info.sightings.OnSeen("left", 3);
  info.sightings.OnMissed("left", 4);
  info.sightings.SetTrack("right", 7);
  const auto before = map.Publish(5);
  ASSERT_TRUE(store_->Commit(*created, *before, Durability::kNormal).ok());
  map.Remove(SubmapId(1));
  const auto after = map.Publish(6);
  const EditRecord record{.entry = {after->revision(), 6, {}, {}}, .answer = "", .before = before};
  ASSERT_TRUE(store_->CommitEdit(*before, *after, record).ok());
  const auto delta = store_->LoadEdit("a", after->revision());
  ASSERT_TRUE(delta.ok()) << delta.status().ToString();
  ASSERT_EQ(delta->submaps.size(), 1u);
  EXPECT_FALSE(delta->submaps[0].after);
  ASSERT_TRUE(delta->submaps[0].before);
  EXPECT_EQ(delta->submaps[0].before->info.sightings, before->Find(SubmapId(1))->info().sightings);
}

TEST_P(EditsTest, TheLogIsBoundedByNumberBytesAndAge) {
  BeginAnew({.max_edits = 5});
  Map map = Create("a");
  for (int i = 0; i < 9; ++i) ASSERT_TRUE(Rename(map, {.request_id = std::to_string(i)}).ok());
  EXPECT_EQ(List().size(), 5u);
  EXPECT_FALSE(*store_->FindAnswer("a", "3"));
  EXPECT_TRUE(*store_->FindAnswer("a", "4"));

  BeginAnew({.max_bytes = 5000});
  Map large = Create("a");
  for (int i = 0; i < 9; ++i) ASSERT_TRUE(Rename(large, {}, 5, std::string(1000, 'x')).ok());
  EXPECT_EQ(List().size(), 4u);

  BeginAnew({.max_age_s = 10});
  Map old = Create("a");
  for (int i = 0; i < 9; ++i) {
    passed_ns_ = std::int64_t{4'000'000'000} * i;
    ASSERT_TRUE(Rename(old, {}).ok());
  }
  EXPECT_EQ(List().size(), 3u) << "those of 8, 4 and 0 s ago";
}

TEST_P(EditsTest, AnEditThatIsLargerThanTheLogIsInItAllTheSame) {
  BeginAnew({.max_bytes = 100});
  Map map = Create("a");
  for (const char* id : {"1", "2"}) ASSERT_TRUE(Rename(map, {.request_id = id}, 5, std::string(1000, 'x')).ok());
  EXPECT_EQ(List().size(), 1u);
  EXPECT_TRUE(*store_->FindAnswer("a", "2")) << "or it would be made twice";
}

TEST_P(EditsTest, WhoKeepsNoHistoriesAnyMoreGetsTheirSpaceBack) {
  Map map = Create("a");
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Rename(map, {}).ok());
  EXPECT_TRUE(List()[2].is_kept);
  const EditLogLimits none{.max_histories = 0};
  if (GetParam() == StoreKind::kMemory) {  // whose limits are for all its life
    BeginAnew(none);
    map = Create("a");
  } else {
    Open(none);
  }
  ASSERT_TRUE(Rename(map, {}).ok());
  ASSERT_FALSE(List().empty());
  for (const LoggedEdit& edit : List()) EXPECT_FALSE(edit.is_kept);
}

INSTANTIATE_TEST_SUITE_P(Stores, EditsTest, ::testing::ValuesIn(testing::AllStores()), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap
