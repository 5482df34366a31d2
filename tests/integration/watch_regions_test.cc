// SPDX-License-Identifier: BSD-3-Clause
// Events of regions in a watch.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "storage/sqlite_store.h"
#include "tests/integration/watcher.h"

namespace dhpmap::testing {
namespace {

/// A mapped room in a database file, whose server can be restarted.
class WatchRegionsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Start();
    ASSERT_OK(server->Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(*server, "room", 0, 6));
    const v1::ListSubmapsResponse list = ListAll(*server->submaps, "room");
    begun = list.revision();
    for (const v1::Submap& submap : list.submaps()) {
      if (submap.class_id() == 1) ball = submap;
    }
    ASSERT_TRUE(ball.has_bounding_sphere());
  }
  void Start() {
    if (server != nullptr) {
      ASSERT_OK(server->Stop());
    }
    server = nullptr;
    store = nullptr;
    auto opened = OpenSqliteStore((folder.path() / "maps.db").string());
    ASSERT_OK(opened);
    store = std::move(opened).value();
    server = std::make_unique<TestServer>(*store);
  }
  std::int64_t Apply(v1::ApplyEditsRequest request) {
    request.set_map("maps/room");
    const auto response = server->Call(&EditStub::ApplyEdits, request).value();
    num_voxels = response.results_size() > 0 ? response.results(0).num_voxels() : 0;
    return response.revision();
  }
  /// The events of regions from the mapped room up to a revision.
  std::vector<v1::RegionEvent> Told(std::int64_t until, const v1::WatchFilter& filter = {}) {
    v1::WatchMapRequest request;
    request.set_map("maps/room");
    request.set_start_revision(begun + 1);
    *request.mutable_filter() = filter;
    Watcher watcher(*server->watches, request);
    std::vector<v1::RegionEvent> told;
    v1::WatchMapResponse message;
    std::int64_t revision = 0;
    while (revision < until && watcher.Read(message)) {
      told.insert(told.end(), message.change().regions().begin(), message.change().regions().end());
      revision = RevisionOf(message.position());
    }
    EXPECT_GE(revision, until);
    return told;
  }

  TempDir folder;
  std::unique_ptr<MapStore> store;
  std::unique_ptr<TestServer> server;
  v1::Submap ball;
  std::int64_t begun = 0, num_voxels = 0;
};

TEST_F(WatchRegionsTest, ClearedIgnoredAndRemovedRegionsAreReportedAlsoAfterARestart) {
  v1::ApplyEditsRequest clear;
  v1::Edit& of_ball = *clear.add_edits();
  of_ball.set_submap(ball.name());
  *of_ball.mutable_clear()->mutable_sphere() = ball.bounding_sphere();
  v1::ClearEdit& of_floor = *clear.add_edits()->mutable_clear();
  of_floor.mutable_box()->mutable_min_m()->set_x(50);
  of_floor.mutable_box()->mutable_max_m()->set_x(51);
  of_floor.add_class_names(ball.class_name());
  of_floor.set_ignored_region_name("door");
  Apply(clear);
  const std::int64_t num_cleared = num_voxels;
  EXPECT_GT(num_cleared, 0);
  v1::ApplyEditsRequest lift;
  lift.add_edits()->mutable_unignore_region()->set_name("door");
  const std::int64_t lifted = Apply(lift);

  for (const bool is_later : {false, true}) {
    if (is_later) Start();
    const auto told = Told(lifted);
    ASSERT_EQ(told.size(), 4u);
    EXPECT_EQ(told[0].kind(), v1::RegionEvent::CLEARED);
    EXPECT_EQ(told[0].submap(), ball.name());
    EXPECT_EQ(told[0].sphere().SerializeAsString(), ball.bounding_sphere().SerializeAsString());
    EXPECT_EQ(told[0].num_voxels(), num_cleared);
    EXPECT_EQ(told[1].kind(), v1::RegionEvent::CLEARED);
    ASSERT_EQ(told[1].class_names_size(), 1);
    EXPECT_EQ(told[1].class_names(0), ball.class_name());
    EXPECT_EQ(told[1].submap(), "");
    EXPECT_EQ(told[2].kind(), v1::RegionEvent::IGNORED);
    EXPECT_EQ(told[2].name(), "door");
    EXPECT_EQ(told[2].box().max_m().x(), 51);
    EXPECT_EQ(told[3].kind(), v1::RegionEvent::UNIGNORED);
    EXPECT_EQ(told[3].name(), "door");
    EXPECT_EQ(told[3].box().min_m().x(), 50);
  }
}

TEST_F(WatchRegionsTest, AnUndoReportsTheIgnoredRegionAsItIsNow) {
  v1::ApplyEditsRequest keep;
  v1::IgnoreRegionEdit& door = *keep.add_edits()->mutable_ignore_region();
  door.set_name("door");
  door.mutable_sphere()->set_radius_m(1);
  Apply(keep);
  ASSERT_OK_AND_ASSIGN(const auto undone, server->Call(&EditStub::UndoEdits, "maps/room"));
  const auto told = Told(undone.revision());
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].kind(), v1::RegionEvent::IGNORED);
  EXPECT_EQ(told[1].kind(), v1::RegionEvent::UNIGNORED);
}

TEST_F(WatchRegionsTest, AFilterSelectsRegionsByPlaceAndNoneIfItSelectsObjects) {
  v1::ApplyEditsRequest clear;
  v1::ClearEdit& corner = *clear.add_edits()->mutable_clear();
  corner.mutable_box()->mutable_min_m()->set_x(50);
  corner.mutable_box()->mutable_max_m()->set_x(51);
  corner.set_ignored_region_name("corner");
  const std::int64_t cleared = Apply(clear);
  v1::WatchFilter here, elsewhere, of_ball;
  here.mutable_region()->mutable_min_m()->set_x(50.5);
  here.mutable_region()->mutable_max_m()->set_x(60);
  elsewhere.mutable_region()->mutable_min_m()->set_x(52);
  elsewhere.mutable_region()->mutable_max_m()->set_x(60);
  of_ball.add_instance_ids(ball.instance_id());
  EXPECT_EQ(Told(cleared, here).size(), 2u);
  EXPECT_TRUE(Told(cleared, elsewhere).empty());
  EXPECT_TRUE(Told(cleared, of_ball).empty());
}

}  // namespace
}  // namespace dhpmap::testing
