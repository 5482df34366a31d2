// SPDX-License-Identifier: BSD-3-Clause
// An edit that was stored although its answer was lost: later requests get the stored state.
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "server/app/maps/map_registry.h"
#include "tests/support/assert_ok.h"
#include "tests/support/eventually.h"
#include "tests/support/lone_fleet.h"
#include "tests/support/wrapped_store.h"
#include "tests/unit/server/app/open_map_fixture.h"

namespace dhpmap {
namespace {

/// On request, makes an edit and loses the answer.
class SilentStore final : public testing::WrappedStore {
 public:
  [[nodiscard]] Fleet* fleet() override { return &fleet_; }
  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    const Status made = inner().CommitEdit(before, after, edit);
    return made.ok() && is_silent.exchange(false) ? Unavailable("no answer") : made;
  }

  std::atomic<bool> is_silent = false;

 private:
  testing::LoneFleet fleet_;
};

/// Adds a thing.
Status EditIn(MapRegistry& registry) {
  const auto room = registry.GetOpen("room");
  if (!room.ok()) return room.status();
  return Wait<Status>([&](auto done) {
    (*room)->Edit([](Map& map) -> Result<SubmapId> { return map.Create({.panoptic = Panoptic::kThing}).id(); },
                  [done](const Result<EditOutcome>& outcome) { done(outcome.status()); });
  });
}

TEST(LostAnswer, AnEditWithALostAnswerIsServedAndLaterEditsSucceed) {
  SilentStore store;
  ASSERT_OK_AND_ASSIGN(const auto registry, MapRegistry::Open(store, {.mapping = {.num_threads = 1}}));
  ASSERT_OK(registry->Create(RoomInfo("room")));
  ASSERT_OK(EditIn(*registry));
  store.is_silent = true;
  EXPECT_EQ(EditIn(*registry).code(), StatusCode::kUnavailable);
  EXPECT_EQ(store.GetMap("room")->num_submaps, 3) << "the unknown one, and two of edits";
  EXPECT_EQ(registry->Get("room")->num_submaps, 2) << "this process has taken it back";
  EXPECT_EQ(EditIn(*registry).code(), StatusCode::kUnavailable) << "clients come again after that";
  EXPECT_TRUE(testing::Eventually([&] { return EditIn(*registry).ok(); }));
  EXPECT_EQ(registry->Get("room")->num_submaps, 4);
  EXPECT_EQ(store.GetMap("room")->num_submaps, 4);
}

}  // namespace
}  // namespace dhpmap
