// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/map_edits.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "server/app/states/etag.h"
#include "tests/support/wrapped_store.h"

namespace dhpmap {
namespace {

TEST(PatchMap, RenamesTheMapInANewRevision) {
  Map map{MapInfo{}};
  const auto before = map.Publish(0);
  ASSERT_TRUE(PatchMap(map, EtagOf(map.info()), {.display_name = "home"}).ok());
  const auto after = map.Publish(0);
  EXPECT_EQ(after->info().display_name, "home");
  EXPECT_EQ(after->revision(), before->revision() + 1);
}

TEST(PatchMap, WithoutEffectMakesNoRevision) {
  Map map{MapInfo{}};
  const auto before = map.Publish(0);
  EXPECT_TRUE(PatchMap(map, "", {}).ok());
  EXPECT_TRUE(PatchMap(map, "", {.display_name = ""}).ok());
  EXPECT_EQ(map.Publish(0), before);
}

TEST(PatchMap, RefusesAnOldEtagAndATooLongTitle) {
  Map map{MapInfo{}};
  const auto before = map.Publish(0);
  EXPECT_EQ(PatchMap(map, "x", {.display_name = "home"}).code(), StatusCode::kAborted);
  const Status status = PatchMap(map, "", {.display_name = std::string(kMaxDisplayNameBytes + 1, 'x')});
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].field, "display_name");
  EXPECT_EQ(map.Publish(0), before);
}

/// An edit log that counts reads.
class RenameLogStore final : public testing::WrappedStore {
 public:
  void Add(EditSummary summary) {
    EditEntry entry;
    entry.revision = ++last_;
    entry.summary = std::move(summary);
    log_.insert(log_.begin(), LoggedEdit{.entry = std::move(entry)});
  }
  Result<std::vector<LoggedEdit>> ListEdits(const std::string&, const EditQuery& query) override {
    ++num_reads;
    std::vector<LoggedEdit> edits;
    for (const LoggedEdit& edit : log_) {
      if (query.before_revision && edit.entry.revision >= *query.before_revision) continue;
      if (edits.size() < query.max_edits) edits.push_back(edit);
    }
    return edits;
  }
  [[nodiscard]] std::int64_t last() const { return last_; }

  int num_reads = 0;

 private:
  std::vector<LoggedEdit> log_;  // the newest first
  std::int64_t last_ = 0;
};

TEST(CheckMapNotEditedSince, SeesRenamesOfTheMapAndTheirUndo) {
  RenameLogStore store;
  const auto reason = [&store](std::int64_t revision) {
    return std::string(CheckMapNotEditedSince(revision, store, "m").reason().name());
  };
  store.Add({.steps = {{EditAction::kRenameMap, kUnknownSubmap}}});
  store.Add({.steps = {{EditAction::kMove, SubmapId(1)}}});
  EXPECT_EQ(reason(0), "");
  EXPECT_EQ(reason(1), "") << "an object was moved";
  store.Add({.kind = EditKind::kUndo, .targets = {2}});
  EXPECT_EQ(reason(1), "");
  store.Add({.kind = EditKind::kUndo, .targets = {1}});
  EXPECT_EQ(reason(3), "EDITED_SINCE") << "of an edit before it";
  EXPECT_EQ(reason(4), "");
  store.Add({.steps = {{EditAction::kRestore, SubmapId(1)}}});
  EXPECT_EQ(reason(4), "") << "an object alone";
  store.Add({.steps = {{EditAction::kRestore, kUnknownSubmap}}});
  EXPECT_EQ(reason(4), "EDITED_SINCE");
  EXPECT_EQ(reason(6), "");
}

/// The map's writer waits for this lookup.
TEST(CheckMapNotEditedSince, LooksUpAnEditOnceHoweverOftenItWasUndone) {
  RenameLogStore store;
  for (int i = 0; i < 10; ++i) store.Add({.steps = {{EditAction::kMove, SubmapId(1)}}});
  for (int i = 0; i < 190; ++i) {
    store.Add({.kind = i % 2 == 0 ? EditKind::kUndo : EditKind::kRedo, .targets = {10, 9, 8, 7, 6, 5, 4, 3, 2, 1}});
  }
  store.num_reads = 0;
  EXPECT_TRUE(CheckMapNotEditedSince(10, store, "m").ok());
  EXPECT_LE(store.num_reads, 12);
}

}  // namespace
}  // namespace dhpmap
