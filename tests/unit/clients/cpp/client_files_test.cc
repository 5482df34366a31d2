// SPDX-License-Identifier: BSD-3-Clause
// Files, voxels and the log of the C++ client, from a real server.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "storage/sqlite_store.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/cpp/client_room.h"

namespace dhpmap::testing {
namespace {

using Format = client::MeshOptions::Format;

using ClientFiles = ClientRoom;

/// Puts the parts together, and looks at what they say of the whole.
client::TakePart Into(std::string& bytes) {
  return [&bytes](const client::FilePart& part) {
    bytes += part.data;
    return true;
  };
}

TEST_F(ClientFiles, MeshesComeInTheirFormats) {
  for (const auto& [format, magic] : {std::pair(Format::kPly, "ply\n"), std::pair(Format::kGlb, "glTF")}) {
    std::string bytes;
    ASSERT_OK_AND_ASSIGN(const auto info, room.Mesh(Into(bytes), {.format = format}));
    EXPECT_TRUE(bytes.starts_with(magic)) << magic;
    EXPECT_EQ(info.num_bytes, static_cast<std::int64_t>(bytes.size()));
    EXPECT_GT(info.revision, 0);
    EXPECT_EQ(info.etag.empty(), format != Format::kGlb);
  }
  std::string one, bytes;
  ASSERT_OK(room.Mesh(Into(one), {.object = ObjectOf(1).id}));
  ASSERT_OK(room.Mesh(Into(bytes)));
  EXPECT_LT(one.size(), bytes.size());
  EXPECT_EQ(room.Mesh(Into(one), {.object = 12345}).status().reason, "SUBMAP_NOT_FOUND");
}

TEST_F(ClientFiles, WhoWantsNoMoreIsNotSentTheRest) {
  int num_parts = 0;
  const auto first_only = [&](const client::FilePart& part) {
    EXPECT_GT(part.total_bytes, 0);
    ++num_parts;
    return false;
  };
  EXPECT_EQ(room.Mesh(first_only).status().code, client::StatusCode::kCancelled);
  EXPECT_EQ(num_parts, 1);
}

TEST_F(ClientFiles, VoxelsAreWhereTheBallIs) {
  const client::Object ball = ObjectOf(1);
  ASSERT_TRUE(ball.bounding_sphere);
  ASSERT_OK_AND_ASSIGN(const auto all, room.Voxels(ball.id));
  ASSERT_GT(all.center_m.size(), 100u);
  for (const std::size_t size :
       {all.tsdf_m.size(), all.weight.size(), all.rgb.size(), all.class_id.size(), all.class_confidence.size()}) {
    EXPECT_EQ(size, all.center_m.size());
  }
  for (std::size_t i = 0; i < all.center_m.size(); ++i) {
    const client::Vector3 &p = all.center_m[i], &c = ball.bounding_sphere->center_m;
    EXPECT_LT(std::hypot(p.x - c.x, p.y - c.y, p.z - c.z), ball.bounding_sphere->radius_m + 0.1);
    EXPECT_GT(all.weight[i], 0);
  }
  ASSERT_OK_AND_ASSIGN(const auto near, room.Voxels(ball.id, {.max_abs_tsdf_m = 0.02}));
  EXPECT_LT(near.tsdf_m.size(), all.tsdf_m.size());
  EXPECT_TRUE(std::all_of(near.tsdf_m.begin(), near.tsdf_m.end(), [](float d) { return std::abs(d) <= 0.02f; }));
}

TEST(ClientMapFiles, AMapThatWasExportedIsThereAgainUnderAnotherNameAndABackupIsADatabase) {
  const TempDir folder;
  const std::string file = (folder.path() / "room.dhpmap").string();
  const auto store = OpenSqliteStore((folder.path() / "maps.db").string()).value();
  TestServer server(*store);
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
  ASSERT_OK(testing::Feed(server, "room", 0, 12));
  ASSERT_OK(server.Call(&MappingStub::FinishMapping, "maps/room"));
  const client::Client connection = ConnectTo(AddressOf(server));
  ASSERT_OK_AND_ASSIGN(const client::Map room, connection.OpenMap("room"));
  std::string bytes, all;
  ASSERT_OK(room.Export(Into(bytes)));
  std::ofstream(file, std::ios::binary) << bytes;
  ASSERT_OK_AND_ASSIGN(const client::Map copy, connection.ImportMap(file, "copy"));
  EXPECT_EQ(copy.name(), "copy");
  ASSERT_OK_AND_ASSIGN(const auto here, copy.Objects());
  ASSERT_OK_AND_ASSIGN(const auto there, room.Objects());
  ASSERT_EQ(here.objects.size(), there.objects.size());
  for (std::size_t i = 0; i < here.objects.size(); ++i) EXPECT_EQ(here.objects[i].name, there.objects[i].name);
  EXPECT_EQ(connection.ImportMap(file, "copy").status().code, client::StatusCode::kAlreadyExists);
  EXPECT_EQ(connection.ImportMap(file + ".none").status().code, client::StatusCode::kInvalidArgument);
  ASSERT_OK_AND_ASSIGN(const auto backup, connection.Backup(Into(all)));
  EXPECT_TRUE(all.starts_with("SQLite format 3"));
  EXPECT_EQ(backup.num_bytes, static_cast<std::int64_t>(all.size()));
}

TEST_F(ClientFiles, TheLogTellsEditsTheNewestFirstAndARestoredMapIsAsItWas) {
  const client::Object ball = ObjectOf(1);
  ASSERT_OK_AND_ASSIGN(const auto before, room.Info());
  ASSERT_OK_AND_ASSIGN(const auto moved, room.Edit().MoveBy(ball.id, {0, 0, 1}).Apply());
  ASSERT_OK(room.Edit({.author = "carl"}).Rename(ball.id, "globe").Apply());
  ASSERT_OK_AND_ASSIGN(const auto log, room.Log());
  ASSERT_EQ(log.size(), 2u);
  EXPECT_EQ(log[0].author, "carl");
  EXPECT_EQ(log[0].actions, std::vector<std::string>{"RENAME"});
  EXPECT_EQ(log[1].revision, moved.revision);
  EXPECT_EQ(log[1].changed, std::vector<std::int64_t>{ball.id});
  EXPECT_TRUE(log[1].is_reversible && !log[1].is_undone);
  EXPECT_GE(log[0].time, log[1].time);
  ASSERT_OK_AND_ASSIGN(const auto annas, room.Log({.author = "anna", .limit = 1}));
  ASSERT_EQ(annas.size(), 1u);
  EXPECT_EQ(annas[0].author, "anna");

  ASSERT_OK_AND_ASSIGN(const auto restored, room.Restore(before.revision));
  EXPECT_EQ(restored.changed, std::vector<std::int64_t>{ball.id});
  ASSERT_OK_AND_ASSIGN(const auto back, room.Get(ball.id));
  EXPECT_EQ(back.T_map_object, ball.T_map_object);
  EXPECT_EQ(back.name, ball.name);
}

}  // namespace
}  // namespace dhpmap::testing
