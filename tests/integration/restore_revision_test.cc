// SPDX-License-Identifier: BSD-3-Clause
// Restoring a map or an object to a revision, as a client does it.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "tests/integration/test_server.h"
#include "tests/integration/test_store.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

constexpr char kRestoreId[] = "00000000-0000-4000-8000-00000000d1e5";

class RestoreRevisionTest : public ::testing::Test {
 protected:
  RestoreRevisionTest() {
    EXPECT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    EXPECT_OK(Feed(server, "room", 0, 10));
  }
  static OpenMapOptions KeepsFew() {
    OpenMapOptions options;
    options.history.max_states = 6;
    return options;
  }

  std::int64_t Now() { return (*server.registry().ViewOf("room"))->snapshot().revision(); }
  /// All objects, without the fields that number their states.
  std::string Objects() {
    auto answer = server.Call(&SubmapStub::ListSubmaps, "maps/room").value();
    answer.clear_revision();
    for (v1::Submap& submap : *answer.mutable_submaps()) {
      submap.clear_revision();
      submap.clear_etag();
    }
    return answer.DebugString();
  }
  std::string Points() {
    auto answer = server.Call(&QueryStub::QueryPoints, TestQuery("room")).value();
    answer.clear_revision();
    return answer.SerializeAsString();
  }
  bool Edit(const std::string& submap, const std::function<void(v1::Edit&)>& fill) {
    v1::ApplyEditsRequest request;
    request.set_map("maps/room");
    request.add_edits()->set_submap("maps/room/submaps/" + submap);
    fill(*request.mutable_edits(0));
    grpc::Status status;
    applied = server.Call(&EditStub::ApplyEdits, request).KeepStatus(status);
    return status.ok();
  }
  bool Rename(const std::string& name) {
    return Edit("1", [&](v1::Edit& edit) { edit.mutable_rename()->set_display_name(name); });
  }
  /// Renames one object, deletes one and copies one.
  void EditAll() {
    ASSERT_TRUE(Rename("lamp"));
    ASSERT_TRUE(Edit("2", [](v1::Edit& edit) { edit.mutable_delete_(); }));
    ASSERT_TRUE(Edit("1", [](v1::Edit& edit) {
      v1::Pose& pose = *edit.mutable_clone()->mutable_map_from_submap();
      pose.mutable_translation_m()->set_z(1);
      pose.mutable_rotation()->set_w(1);
    }));
  }
  static v1::RestoreRevisionRequest Request(std::int64_t revision, const std::string& submap = "") {
    v1::RestoreRevisionRequest request;
    request.set_map("maps/room");
    request.set_revision(revision);
    if (!submap.empty()) request.set_submap("maps/room/submaps/" + submap);
    return request;
  }
  /// Returns "OK" or the reason.
  std::string Restore(const v1::RestoreRevisionRequest& request) {
    grpc::Status status;
    response = server.Call(&EditStub::RestoreRevision, request).KeepStatus(status);
    return status.ok() ? "OK" : ReasonOf(status);
  }

  std::unique_ptr<MapStore> store = MakeTestStore();
  TestServer server{*store, KeepsFew()};
  v1::RestoreRevisionResponse response;
  v1::ApplyEditsResponse applied;  // the last one
};

TEST_F(RestoreRevisionTest, TheMapAnswersAsBeforeAndTheRestoreIsLogged) {
  const std::int64_t past = Now();
  const std::string objects = Objects(), points = Points();
  EditAll();
  const std::string edited = Objects();
  v1::RestoreRevisionRequest request = Request(past);
  request.set_author("anna");
  request.set_validate_only(true);
  ASSERT_EQ(Restore(request), "OK");
  EXPECT_EQ(Objects(), edited) << "only tried";
  const v1::RestoreRevisionResponse tried = response;
  request.set_validate_only(false);
  ASSERT_EQ(Restore(request), "OK");
  EXPECT_EQ(response.revision(), past + 4);
  EXPECT_EQ(response.created_submaps_size(), 1);
  EXPECT_EQ(response.created_submaps(0), "maps/room/submaps/2");
  EXPECT_EQ(response.removed_submaps_size(), 1);
  EXPECT_EQ(response.changed_submaps_size(), 1);
  EXPECT_EQ(tried.created_submaps(0) + tried.removed_submaps(0) + tried.changed_submaps(0),
            response.created_submaps(0) + response.removed_submaps(0) + response.changed_submaps(0));
  EXPECT_EQ(Objects(), objects);
  EXPECT_EQ(Points(), points);

  v1::ListEditsRequest list;
  list.set_parent("maps/room");
  list.set_author("anna");
  ASSERT_OK_AND_ASSIGN(const auto log, server.Call(&EditStub::ListEdits, list));
  ASSERT_EQ(log.edits_size(), 1);
  ASSERT_EQ(log.edits(0).steps_size(), 1);
  EXPECT_EQ(log.edits(0).steps(0).action(), v1::LoggedEdit::RESTORE);
  EXPECT_EQ(log.edits(0).restored_revision(), past);
  EXPECT_TRUE(log.edits(0).reversible());

  v1::UndoEditsRequest undo;
  undo.set_map("maps/room");
  undo.set_author("anna");
  ASSERT_OK(server.Call(&EditStub::UndoEdits, undo));
  EXPECT_EQ(Objects(), edited);
}

TEST_F(RestoreRevisionTest, ARetryGetsTheSameAnswerAfterTheStateWasDropped) {
  const std::int64_t past = Now();
  EditAll();
  v1::RestoreRevisionRequest request = Request(past);
  request.set_request_id(kRestoreId);
  ASSERT_EQ(Restore(request), "OK");
  const std::string first = response.SerializeAsString();
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(Rename("name " + std::to_string(i)));
  EXPECT_EQ(Restore(Request(past)), "REVISION_NOT_KEPT");
  ASSERT_EQ(Restore(request), "OK");
  EXPECT_EQ(response.SerializeAsString(), first);
  request.set_revision(past + 1);
  EXPECT_EQ(Restore(request), "REQUEST_ID_REUSED");
}

TEST_F(RestoreRevisionTest, OneObjectIsRestoredAndOthersStay) {
  const std::int64_t past = Now();
  EditAll();
  const std::string copy = applied.results(0).created_submaps(0);
  ASSERT_EQ(Restore(Request(past, "2")), "OK");
  EXPECT_EQ(response.created_submaps_size(), 1);
  EXPECT_NE(Objects().find("lamp"), std::string::npos) << "of another object";
  ASSERT_EQ(Restore(Request(past, "1")), "OK");
  EXPECT_EQ(response.changed_submaps_size(), 1);
  EXPECT_NE(Objects().find("\"lamp\""), std::string::npos) << "of the copy";
  EXPECT_EQ(Objects().find("\"lamp\""), Objects().rfind("\"lamp\""));
  v1::RestoreRevisionRequest request = Request(past);
  request.set_submap(copy);
  EXPECT_EQ(Restore(request), "SUBMAP_NOT_FOUND") << "it was not there";
}

TEST_F(RestoreRevisionTest, InvalidRequestsHaveDifferentErrors) {
  const std::int64_t past = Now();
  EXPECT_EQ(Restore(Request(0)), "BAD_REVISION");
  EXPECT_EQ(Restore(Request(past + 1)), "BAD_REVISION");
  v1::RestoreRevisionRequest request = Request(past);
  request.set_submap("maps/other/submaps/1");
  EXPECT_EQ(Restore(request), "BAD_EDIT");
  request.set_submap("x");
  EXPECT_EQ(Restore(request), "BAD_NAME");
  request = Request(past);
  request.set_expected_revision(-1);
  EXPECT_EQ(Restore(request), "BAD_EDIT");
  request.set_expected_revision(past);
  ASSERT_TRUE(Rename("lamp"));
  EXPECT_EQ(Restore(request), "EDITED_SINCE");
  request.set_expected_revision(past + 1);
  EXPECT_EQ(Restore(request), "OK");
  request.set_map("maps/nowhere");
  EXPECT_EQ(Restore(request), "MAP_NOT_FOUND");
}

TEST_F(RestoreRevisionTest, MappingContinuesFromTheRestoredState) {
  const std::int64_t past = Now();
  EditAll();
  ASSERT_EQ(Restore(Request(past)), "OK");
  const FeedResult fed = Feed(server, "room", 10, 16);
  ASSERT_OK(fed);
  const auto state = (*server.registry().ViewOf("room"))->shared_snapshot();
  EXPECT_EQ(state->info().num_frames, 16) << "frames are counted on";
  // Frames are matched to the restored objects: the same map without the edits gets no other object.
  const auto twin_store = MakeTestStore();
  TestServer twin(*twin_store);
  ASSERT_OK(twin.Call(&MapStub::CreateMap, CreateRequest("room")));
  ASSERT_OK(Feed(twin, "room", 0, 10));
  ASSERT_OK(Feed(twin, "room", 10, 16));
  EXPECT_EQ(state->submaps().size(), (*twin.registry().ViewOf("room"))->snapshot().submaps().size());
}

}  // namespace
}  // namespace dhpmap::testing
