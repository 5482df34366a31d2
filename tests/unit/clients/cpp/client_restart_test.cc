// SPDX-License-Identifier: BSD-3-Clause
// A feed and a watch of the C++ client outlast a server that is killed and comes back.
#include <csignal>
#include <optional>

#include "tests/e2e/server_process.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/cpp/client_room.h"
#include "tests/unit/clients/cpp/owned_frame.h"

namespace dhpmap::testing {
namespace {

TEST(ClientRestart, NoFrameAndNoChangeIsLostWithAKilledServer) {
  const TempDir dir;
  const std::string address = AddressToComeBackTo();
  std::optional<ServerProcess> server(std::in_place, dir.path(), dir.path() / "maps.db", address);
  ASSERT_TRUE(server->is_serving());
  const client::Map map = CreateFedRoom(ConnectTo(address));
  client::Watch watch = map.Watch({.after_revision = 0});
  const OwnedFrame first(0);
  ASSERT_OK_AND_ASSIGN(auto feed, map.Feed({.session = "robot1", .camera = first.camera}));
  constexpr int kFrames = 30;
  for (int i = 0; i < kFrames; ++i) {
    if (i == kFrames / 2) {
      server->process().Signal(SIGKILL);
      ASSERT_TRUE(server->process().Wait().has_value());
      server.emplace(dir.path(), dir.path() / "maps.db", address);
      ASSERT_TRUE(server->is_serving());
    }
    const OwnedFrame owned(i);
    ASSERT_OK(feed.Push(owned.frame));
  }
  ASSERT_OK(feed.Close());
  EXPECT_EQ(feed.state().stored_sequence, kFrames);
  EXPECT_TRUE(feed.TakeNotes().empty());
  ASSERT_OK_AND_ASSIGN(const auto info, map.Info());
  EXPECT_EQ(info.num_frames, kFrames);

  // What the watch has told, put together, is what there is.
  ASSERT_OK_AND_ASSIGN(const auto list, map.Objects());
  std::map<std::int64_t, std::int64_t> revisions;
  std::int64_t last = 0;
  while (watch.revision() < list.revision) {
    ASSERT_OK_AND_ASSIGN(const auto change, watch.Next(0.05));
    if (!change) continue;
    EXPECT_GE(change->revision, last);
    last = change->revision;
    if (change->kind == client::Change::Kind::kCreated || change->kind == client::Change::Kind::kChanged) {
      revisions[change->object.id] = change->object.revision;
    } else {
      revisions.erase(change->object.id);
    }
  }
  while (true) {  // what is told, but not taken yet
    ASSERT_OK_AND_ASSIGN(const auto change, watch.Next(0));
    if (!change) break;
    revisions[change->object.id] = change->object.revision;
  }
  for (const client::Object& object : list.objects) {
    if (object.id == 0) continue;  // the unknown object is told of, too, once it has something
    EXPECT_EQ(revisions[object.id], object.revision) << object.name;
  }
}

}  // namespace
}  // namespace dhpmap::testing
