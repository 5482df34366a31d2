// SPDX-License-Identifier: BSD-3-Clause
// Edits and watches of the C++ client against a real server.
#include <array>
#include <thread>

#include "tests/integration/tcp_proxy.h"
#include "tests/unit/clients/cpp/client_room.h"

namespace dhpmap::testing {
namespace {

using ClientEdits = ClientRoom;

TEST_F(ClientEdits, AListIsOneRevisionAndUndoneAsOne) {
  const client::Object ball = ObjectOf(1);
  client::Edit edit = room.Edit();
  edit.MoveBy(ball.id, {0, 0, 0.5});
  const client::NewObject copy = edit.Clone(ball.id, {}, "twin");
  edit.MoveBy(copy, {0, 1, 0});
  ASSERT_OK_AND_ASSIGN(const auto preview, edit.Preview());
  EXPECT_EQ(ObjectOf(1).revision, ball.revision);
  ASSERT_OK_AND_ASSIGN(const auto edited, edit.Apply());
  ASSERT_EQ(edited.results.size(), 3);
  EXPECT_EQ(edited.results[1].created, preview.results[1].created);
  ASSERT_OK_AND_ASSIGN(const auto twin, room.Get(edited.results[1].created.at(0)));
  EXPECT_EQ(twin.name, "twin");
  EXPECT_NEAR(twin.T_map_object.translation_m.y, ball.T_map_object.translation_m.y + 1, 1e-9);

  ASSERT_OK_AND_ASSIGN(const auto undone, room.Undo());
  EXPECT_EQ(undone.edits, std::vector<std::int64_t>{edited.revision});
  ASSERT_OK_AND_ASSIGN(const auto back, room.Get(ball.id));
  EXPECT_EQ(back.T_map_object, ball.T_map_object);
  EXPECT_EQ(room.Get(twin.id).status().code, client::StatusCode::kNotFound);
  ASSERT_OK(room.Redo());
  ASSERT_OK(room.Get(twin.id));
}

TEST_F(ClientEdits, OneBadEditUndoesTheList) {
  const client::Object ball = ObjectOf(1);
  client::Edit edit = room.Edit();
  edit.MoveBy(ball.id, {0, 0, 0.5}).Delete(12345);
  const auto refused = edit.Apply();
  EXPECT_EQ(refused.status().code, client::StatusCode::kNotFound);
  ASSERT_OK_AND_ASSIGN(const auto after, room.Get(ball.id));
  EXPECT_EQ(after.T_map_object, ball.T_map_object);
}

TEST_F(ClientEdits, WhatWasEditedSinceItWasGotIsLeftAloneIfAskedSo) {
  const client::Object ball = ObjectOf(1);
  client::Edit first = room.Edit();
  ASSERT_OK(first.Rename(ball.id, "globe").Apply());
  client::Edit second = room.Edit({.only_if_unedited = true});
  const auto refused = second.Rename(ball, "sphere").Apply();
  EXPECT_EQ(refused.status().code, client::StatusCode::kAborted);
  EXPECT_EQ(refused.status().reason, "ETAG_MISMATCH");
}

TEST_F(ClientEdits, EveryKindOfEditReachesTheServer) {
  const client::Object ball = ObjectOf(1), box = ObjectOf(2);
  const auto apply = [&](auto add) {
    client::Edit edit = room.Edit();
    add(edit);
    EXPECT_OK(edit.Apply());
  };
  apply([&](client::Edit& e) { e.SetLocked(ball.id, true); });
  EXPECT_TRUE(ObjectOf(1).is_locked);
  apply([&](client::Edit& e) { e.SetLocked(ball.id, false).SetPresent(ball.id, false); });
  EXPECT_FALSE(ObjectOf(1).is_present);
  apply([&](client::Edit& e) { e.SetPresent(ball.id, true).Place(ball.id, box.id); });
  EXPECT_NEAR(ObjectOf(1).box->T_map_box.translation_m.x, 1.2, 0.1);
  apply([&](client::Edit& e) { e.Turn(box.id, 0.5).MoveTo(ball.id, client::PoseAt({0, 0, 2}, 1)); });
  EXPECT_NEAR(ObjectOf(1).T_map_object.translation_m.z, 2, 1e-9);
  apply([&](client::Edit& e) { e.IgnoreRegion("door", client::Sphere{{2, 2, 2}, 0.3}).UnignoreRegion("door"); });
  apply([&](client::Edit& e) { e.Split(box.id, {{0, -1, 0}, {1.2, 2, 2}}); });
  apply([&](client::Edit& e) { e.Relabel(ball.id, box.class_name); });
  apply([&](client::Edit& e) { e.Clear(client::Box{{-9, -9, -1}, {-8, -8, 1}}); });
  apply([&](client::Edit& e) { e.Delete(ball.id); });
  apply([&](client::Edit& e) { e.Undelete(ball.id); });
  ASSERT_OK(room.Get(ball.id));
}

TEST_F(ClientEdits, AWatchTellsEachChangeOnceThoughItsConnectionIsCutAgainAndAgain) {
  const client::Object ball = ObjectOf(1);
  CuttingProxy proxy(server.grpc().port(), 11);
  // The proxy cuts connecting, too; a try is for free.
  client::Result<client::Client> cut = client::Client::Connect(proxy.address());
  ASSERT_OK(cut);
  client::Result<client::Map> cut_room = cut->OpenMap("room");
  ASSERT_OK(cut_room);
  ASSERT_OK_AND_ASSIGN(const auto list, room.Objects());
  client::Watch watch = cut_room->Watch({.objects = {ball.id}, .after_revision = list.revision});

  constexpr int kRenames = 40;
  std::vector<std::string> told;
  for (int i = 0; i < kRenames; ++i) {
    client::Edit edit = room.Edit();
    ASSERT_OK(edit.Rename(ball.id, "ball " + std::to_string(i)).Apply());
    ASSERT_OK_AND_ASSIGN(const auto change, watch.Next());
    ASSERT_TRUE(change.has_value());
    EXPECT_EQ(change->kind, client::Change::Kind::kChanged);
    EXPECT_EQ(change->parts, std::vector{client::Change::Part::kName});
    EXPECT_EQ(change->object.name, "ball " + std::to_string(i));
    EXPECT_EQ(watch.revision(), change->revision);
  }
}

TEST_F(ClientEdits, AWatchSaysNothingAfterItsIdleTimeAndGoesOn) {
  client::Watch watch = room.Watch();
  ASSERT_OK_AND_ASSIGN(const auto nothing, watch.Next(0));
  EXPECT_FALSE(nothing.has_value());
  while (watch.revision() == 0) ASSERT_OK(watch.Next(0.01));  // it has begun
  client::Edit edit = room.Edit();
  ASSERT_OK_AND_ASSIGN(const auto edited, edit.Rename(ObjectOf(2).id, "crate").Apply());
  ASSERT_OK_AND_ASSIGN(const auto change, watch.Next());
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->object.name, "crate");
  EXPECT_EQ(change->revision, edited.revision);

  client::Watch later = room.Watch({.resume_after = change->position});
  ASSERT_OK(room.Undo());
  ASSERT_OK_AND_ASSIGN(const auto back, later.Next());
  EXPECT_NE(back->object.name, "crate");
}

TEST_F(ClientEdits, AWatchIsClosedFromAnotherThread) {
  client::Watch watch = room.Watch();
  while (watch.revision() == 0) ASSERT_OK(watch.Next(0.01));
  std::jthread closer([&] { watch.Close(); });
  ASSERT_OK_AND_ASSIGN(const auto nothing, watch.Next());
  EXPECT_FALSE(nothing.has_value());
}

TEST_F(ClientEdits, AWatchOfWhatIsNoLongerThereEnds) {
  client::Watch watch = room.Watch();
  while (watch.revision() == 0) ASSERT_OK(watch.Next(0.01));
  ASSERT_OK(connection.DeleteMap("room"));
  while (true) {
    const auto change = watch.Next();
    if (change.ok()) continue;
    EXPECT_EQ(change.status().code, client::StatusCode::kNotFound);
    break;
  }
}

}  // namespace
}  // namespace dhpmap::testing
