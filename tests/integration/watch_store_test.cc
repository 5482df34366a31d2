// SPDX-License-Identifier: BSD-3-Clause
// Watching a map in a file, across restarts and a restore.
#include <fstream>
#include <random>

#include "storage/sqlite_store.h"
#include "tests/integration/watcher.h"

namespace dhpmap::testing {
namespace {

class StoredWatchTest : public ::testing::Test {
 protected:
  void Start(const std::string& file) {
    Stop();
    auto opened = OpenSqliteStore((folder_.path() / file).string());
    ASSERT_OK(opened);
    store_ = std::move(*opened);
    server_ = std::make_unique<TestServer>(*store_);
  }
  void Stop() {
    server_ = nullptr;
    store_ = nullptr;
  }
  void CreateMap() { ASSERT_OK(server_->Call(&MapStub::CreateMap, CreateRequest("room"))); }
  /// Moves, clones or deletes an object, or renames it.
  void Edit(std::mt19937& random) {
    const v1::ListSubmapsResponse list = ListAll(*server_->submaps, "room");
    const v1::Submap& submap = list.submaps(static_cast<int>(random() % static_cast<unsigned>(list.submaps_size())));
    if (random() % 4 == 0) {
      (void)server_->Call(&SubmapStub::DeleteSubmap, submap.name());  // the unknown submap: refused
    } else if (random() % 3 == 0) {
      (void)server_->Call(&SubmapStub::CloneSubmap, submap.name());
    } else {
      v1::UpdateSubmapRequest request;
      request.mutable_submap()->set_name(submap.name());
      request.mutable_submap()->set_display_name("name " + std::to_string(random() % 100));
      request.mutable_submap()->mutable_map_from_submap()->mutable_translation_m()->set_x(random() % 7);
      request.mutable_update_mask()->add_paths(random() % 2 == 0 ? "display_name" : "map_from_submap");
      (void)server_->Call(&SubmapStub::UpdateSubmap, request);
    }
  }

  TempDir folder_;
  std::unique_ptr<MapStore> store_;
  std::unique_ptr<TestServer> server_;
};

TEST_F(StoredWatchTest, FromAnyListItLeadsToThePresentOne) {
  std::mt19937 random(11);
  Start("maps.db");
  CreateMap();
  std::vector<v1::ListSubmapsResponse> lists;
  int frame = 0;
  for (int step = 0; step < 60; ++step) {
    const auto kind = random() % 12;
    if (kind < 3) {
      ASSERT_OK(Feed(*server_, "room", frame, frame + 2));
      frame += 2;
    } else if (kind == 3) {
      Start("maps.db");
    } else {
      Edit(random);
    }
    if (random() % 4 == 0) lists.push_back(ListAll(*server_->submaps, "room"));
  }
  const v1::ListSubmapsResponse now = ListAll(*server_->submaps, "room");
  ASSERT_GT(frame, 10);
  for (const v1::ListSubmapsResponse& list : lists) {
    HeldSubmaps held(list);
    Watcher watcher(*server_, "room", list.revision() + 1);
    ASSERT_TRUE(watcher.FollowTo(now.revision(), held)) << "from revision " << list.revision();
    EXPECT_EQ(held.submaps(), HeldSubmaps(now).submaps()) << "from revision " << list.revision();
  }
}

TEST_F(StoredWatchTest, AfterARestoreEarlierPositionsAreLost) {
  Start("maps.db");
  CreateMap();
  ASSERT_OK(Feed(*server_, "room", 0, 4));
  auto backup = store_->Backup({});
  ASSERT_OK(backup);
  {
    std::ofstream copy(folder_.path() / "restored.db", std::ios::binary);
    for (std::string part = *(*backup)->Read(1 << 20); !part.empty(); part = *(*backup)->Read(1 << 20)) copy << part;
  }
  HeldSubmaps held(ListAll(*server_->submaps, "room"));
  v1::WatchMapRequest request;
  request.set_map("maps/room");
  {
    Watcher watcher(*server_, "room", held.revision());
    ASSERT_TRUE(watcher.FollowTo(held.revision(), held));
    request.set_resume_after(watcher.position());
  }
  Start("restored.db");
  const grpc::Status ended = Watcher(*server_->watches, request).Finish();
  EXPECT_EQ(ended.error_code(), grpc::OUT_OF_RANGE) << ended.error_message();
  EXPECT_EQ(ErrorInfoOf(ended).reason(), "HISTORY_LOST");
  HeldSubmaps listed(ListAll(*server_->submaps, "room"));
  Watcher watcher(*server_, "room", listed.revision() + 1);
  ASSERT_OK(Feed(*server_, "room", 4, 6));
  const v1::ListSubmapsResponse now = ListAll(*server_->submaps, "room");
  ASSERT_TRUE(watcher.FollowTo(now.revision(), listed));
  EXPECT_EQ(listed.submaps(), HeldSubmaps(now).submaps());
}

}  // namespace
}  // namespace dhpmap::testing
