// SPDX-License-Identifier: BSD-3-Clause
// Preconditions of calls, by etag or revision: across frames, edits of others, restarts, a restore and a crash.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "storage/sqlite_store.h"
#include "tests/integration/feeder.h"
#include "tests/integration/test_server.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

/// A mapped room in a database file. Its server can be restarted, on that file or another.
class PreconditionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Start("maps.db");
    ASSERT_OK(server_->Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(*server_, "room", 0, 12));
    const v1::ListSubmapsResponse all = List(*server_);
    for (const v1::Submap& submap : all.submaps()) {
      if (submap.class_id() == 1) ball_ = submap;
      if (submap.class_id() == 2) box_ = submap;
    }
    ASSERT_TRUE(ball_.instance_id() > 0 && box_.instance_id() > 0);
  }
  void Start(const std::string& file, const OpenMapOptions& session = {}) {
    server_ = nullptr;
    store_ = nullptr;
    auto opened = OpenSqliteStore(Path(file));
    ASSERT_OK(opened);
    store_ = std::move(opened).value();
    server_ = std::make_unique<TestServer>(*store_, session);
  }
  [[nodiscard]] std::string Path(const std::string& file) const { return (folder_.path() / file).string(); }

  static v1::ListSubmapsResponse List(TestServer& server) {
    return server.Call(&SubmapStub::ListSubmaps, "maps/room").value();
  }
  v1::Submap Get(const std::string& name) { return server_->Call(&SubmapStub::GetSubmap, name).value().submap(); }
  v1::UpdateSubmapResponse Update(const v1::Submap& submap, const std::string& mask) {
    v1::UpdateSubmapRequest request;
    *request.mutable_submap() = submap;
    request.mutable_update_mask()->add_paths(mask);
    const auto answer = server_->Call(&SubmapStub::UpdateSubmap, request);
    reason_ = OutcomeOf(answer.status());
    return *answer;
  }
  /// Each function returns "OK" or the reason.
  std::string Rename(const v1::Submap& submap, const std::string& display_name, const std::string& etag) {
    v1::Submap wanted;
    wanted.set_name(submap.name());
    wanted.set_display_name(display_name);
    wanted.set_etag(etag);
    Update(wanted, "display_name");
    return reason_;
  }
  std::string Clone(const v1::Submap& submap, const std::string& etag) {
    v1::CloneSubmapRequest request;
    request.set_name(submap.name());
    request.set_etag(etag);
    return OutcomeOf(server_->Call(&SubmapStub::CloneSubmap, request).status());
  }
  std::string Delete(const v1::Submap& submap, const std::string& etag) {
    v1::DeleteSubmapRequest request;
    request.set_name(submap.name());
    request.set_etag(etag);
    return OutcomeOf(server_->Call(&SubmapStub::DeleteSubmap, request).status());
  }
  std::string Apply(v1::ApplyEditsRequest request) {
    request.set_map("maps/room");
    return OutcomeOf(server_->Call(&EditStub::ApplyEdits, request).status());
  }
  std::string Ask(std::int64_t min_revision) {
    v1::QueryDistancesRequest request;
    request.set_map("maps/room");
    request.add_points_m()->set_z(1.3);
    request.mutable_options()->set_min_revision(min_revision);
    return OutcomeOf(server_->Call(&QueryStub::QueryDistances, request).status());
  }
  static std::string OutcomeOf(const grpc::Status& status) {
    if (status.ok()) return "OK";
    const std::string reason = ReasonOf(status);
    return reason.empty() ? status.error_message() : reason;
  }

  /// Frames that become visible but are never stored, then a crash. Returns the list as it was before the crash.
  v1::ListSubmapsResponse FeedAndCrash() {
    Start("maps.db", {.publish = {.frames = 1}, .commit = {.frames = 1000, .delay_s = 1000}});
    Feeder feeder(*server_, "room");
    EXPECT_TRUE(feeder.Feed(12) && feeder.Feed(13));
    v1::ListSubmapsResponse seen = List(*server_);
    for (const char* part : {"", "-wal"}) {
      std::filesystem::copy_file(Path("maps.db") + part, Path("crashed.db") + part);
    }
    feeder.Cancel();
    (void)feeder.Finish();
    Start("crashed.db");
    return seen;
  }
  static v1::Submap In(const v1::ListSubmapsResponse& list, const v1::Submap& wanted) {
    for (const v1::Submap& submap : list.submaps()) {
      if (submap.name() == wanted.name()) return submap;
    }
    ADD_FAILURE() << wanted.name() << " is not there";
    return {};
  }

  TempDir folder_;
  std::unique_ptr<MapStore> store_;
  std::unique_ptr<TestServer> server_;
  std::string reason_;
  v1::Submap ball_, box_;
};

TEST_F(PreconditionTest, AnEtagFromBeforeMoreFramesIsValidInEveryEdit) {
  auto see_more = [this, frame = 12]() mutable {
    const v1::Submap before = Get(ball_.name());
    ASSERT_OK(Feed(*server_, "room", frame, frame + 4));
    frame += 4;
    EXPECT_GT(Get(ball_.name()).revision(), before.revision());
    EXPECT_NE(Get(ball_.name()).etag(), before.etag()) << "as a whole it changes with whatever changes";
  };
  see_more();
  EXPECT_EQ(Rename(ball_, "mine", ball_.etag()), "OK");
  v1::ApplyEditsRequest list;
  list.add_edits()->set_submap(ball_.name());
  list.mutable_edits(0)->set_etag(Get(ball_.name()).etag());
  list.mutable_edits(0)->mutable_rename()->set_display_name("mine again");
  see_more();
  EXPECT_EQ(Apply(list), "OK");
  const std::string etag = Get(ball_.name()).etag();
  see_more();
  EXPECT_EQ(Clone(ball_, etag), "OK");
  EXPECT_EQ(Delete(ball_, etag), "OK");
}

TEST_F(PreconditionTest, AnEtagFromBeforeAnotherEditIsRefusedInEveryEdit) {
  ASSERT_EQ(Rename(ball_, "of another client", ""), "OK");
  ASSERT_OK(Feed(*server_, "room", 12, 14));
  EXPECT_EQ(Rename(ball_, "mine", ball_.etag()), "ETAG_MISMATCH");
  EXPECT_EQ(Clone(ball_, ball_.etag()), "ETAG_MISMATCH");
  EXPECT_EQ(Delete(ball_, ball_.etag()), "ETAG_MISMATCH");
  v1::ApplyEditsRequest list;
  list.add_edits()->set_submap(ball_.name());
  list.mutable_edits(0)->set_etag(ball_.etag());
  list.mutable_edits(0)->mutable_rename()->set_display_name("mine");
  EXPECT_EQ(Apply(list), "ETAG_MISMATCH");
  EXPECT_EQ(Get(ball_.name()).display_name(), "of another client");
}

TEST_F(PreconditionTest, AnEtagIsRefusedAfterADeletionOrAMerge) {
  v1::ApplyEditsRequest merge;
  merge.add_edits()->set_submap(ball_.name());
  merge.mutable_edits(0)->mutable_merge()->add_merged_submaps(box_.name());
  ASSERT_EQ(Apply(merge), "OK");
  EXPECT_EQ(Rename(box_, "x", box_.etag()), "MERGED_INTO");
  EXPECT_EQ(Rename(ball_, "x", ball_.etag()), "ETAG_MISMATCH");
  const std::string etag = Get(ball_.name()).etag();
  ASSERT_EQ(Delete(ball_, etag), "OK");
  EXPECT_EQ(Rename(ball_, "x", etag), "SUBMAP_NOT_FOUND");
  ASSERT_OK(server_->Call(&SubmapStub::UndeleteSubmap, ball_.name()));
  EXPECT_EQ(Rename(ball_, "x", etag), "ETAG_MISMATCH") << "it was away meanwhile";
}

TEST_F(PreconditionTest, AnEtagOfAnotherObjectIsRefused) {
  v1::ApplyEditsRequest both;  // so that both have the same revision
  for (const v1::Submap& submap : {ball_, box_}) {
    v1::Edit& edit = *both.add_edits();
    edit.set_submap(submap.name());
    edit.mutable_rename()->set_display_name("one of two");
  }
  ASSERT_EQ(Apply(both), "OK");
  ASSERT_EQ(Get(ball_.name()).revision(), Get(box_.name()).revision());
  EXPECT_EQ(Delete(ball_, Get(box_.name()).etag()), "ETAG_MISMATCH");
  EXPECT_EQ(Delete(ball_, Get(ball_.name()).etag()), "OK");
}

TEST_F(PreconditionTest, AnEtagSurvivesARestartButNotARestore) {
  {
    auto backup = store_->Backup({});
    ASSERT_OK(backup);
    std::ofstream copy(Path("restored.db"), std::ios::binary);
    for (std::string part = *(*backup)->Read(1 << 20); !part.empty(); part = *(*backup)->Read(1 << 20)) copy << part;
  }
  ASSERT_OK(server_->Stop());
  Start("maps.db");
  ASSERT_OK(Feed(*server_, "room", 12, 14));
  EXPECT_EQ(Rename(ball_, "mine", ball_.etag()), "OK");
  Start("restored.db");
  EXPECT_EQ(Rename(ball_, "mine", ball_.etag()), "ETAG_MISMATCH");
  EXPECT_EQ(Rename(ball_, "mine", Get(ball_.name()).etag()), "OK");
}

TEST_F(PreconditionTest, AnEditWithoutEffectChangesNeitherEtagNorRevision) {
  ball_.clear_etag();
  ball_.mutable_map_from_submap()->mutable_translation_m()->set_x(0.1);
  ball_.mutable_map_from_submap()->mutable_rotation()->set_x(0.3);
  const v1::UpdateSubmapResponse first = Update(ball_, "*");
  ASSERT_EQ(reason_, "OK");
  const v1::UpdateSubmapResponse again = Update(first.submap(), "*");
  ASSERT_EQ(reason_, "OK");
  EXPECT_EQ(again.SerializeAsString(), first.SerializeAsString());
  EXPECT_EQ(List(*server_).revision(), first.revision());
  v1::Submap locked = first.submap();
  locked.set_locked(true);
  const v1::UpdateSubmapResponse changed = Update(locked, "*");
  ASSERT_EQ(reason_, "OK") << "the etag is still the present one";
  EXPECT_EQ(changed.revision(), first.revision() + 1);
  EXPECT_NE(changed.submap().etag(), first.submap().etag());
}

TEST_F(PreconditionTest, ARevisionLostInACrashIsNeitherAwaitedNorReused) {
  const std::int64_t stored = List(*server_).revision();
  const std::int64_t lost = FeedAndCrash().revision();
  ASSERT_GT(lost, stored);
  EXPECT_EQ(Ask(stored), "OK");
  EXPECT_EQ(Ask(lost), "HISTORY_LOST");
  ASSERT_OK(Feed(*server_, "room", 12, 14));
  EXPECT_EQ(Ask(lost), "HISTORY_LOST") << "for ever";
  EXPECT_EQ(Ask(List(*server_).revision()), "OK");
}

TEST_F(PreconditionTest, ARevisionLostInACrashCannotBeRead) {
  const std::int64_t lost = FeedAndCrash().revision();
  ASSERT_OK(Feed(*server_, "room", 12, 14));
  v1::ListSubmapsRequest request;
  request.set_parent("maps/room");
  request.set_read_revision(lost);
  EXPECT_EQ(OutcomeOf(server_->Call(&SubmapStub::ListSubmaps, request).status()), "HISTORY_LOST");
}

TEST_F(PreconditionTest, AnEditThatExpectsARevisionLostInACrashIsRefused) {
  const std::int64_t stored = List(*server_).revision();
  v1::ApplyEditsRequest request;
  request.add_edits()->set_submap(ball_.name());
  request.mutable_edits(0)->mutable_rename()->set_display_name("mine");
  request.set_expected_revision(FeedAndCrash().revision());
  ASSERT_GT(request.expected_revision(), stored);
  EXPECT_EQ(Apply(request), "HISTORY_LOST");
  request.set_expected_revision(stored);
  EXPECT_EQ(Apply(request), "OK");
}

TEST_F(PreconditionTest, AStreamOfQueriesReportsARevisionLostInACrash) {
  const std::int64_t lost = FeedAndCrash().revision();
  grpc::ClientContext context;
  const auto stream = server_->queries->StreamQueries(&context);
  v1::StreamQueriesRequest request;
  request.mutable_query_distances()->set_map("maps/room");
  request.mutable_query_distances()->add_points_m()->set_z(1.3);
  request.mutable_query_distances()->mutable_options()->set_min_revision(lost);
  v1::StreamQueriesResponse response;
  ASSERT_TRUE(stream->Write(request) && stream->Read(&response));
  EXPECT_EQ(response.error().code(), grpc::OUT_OF_RANGE) << response.error().message();
  stream->WritesDone();
  EXPECT_OK(stream->Finish());
}

TEST_F(PreconditionTest, AnEtagLostInACrashIsRefusedAndAnEarlierOneIsValid) {
  const v1::Submap seen = In(FeedAndCrash(), ball_);
  ASSERT_NE(seen.etag(), ball_.etag());
  EXPECT_EQ(Rename(ball_, "x", seen.etag()), "ETAG_MISMATCH");
  ASSERT_OK(Feed(*server_, "room", 12, 14));
  ASSERT_GT(Get(ball_.name()).revision(), seen.revision());
  EXPECT_EQ(Rename(ball_, "x", seen.etag()), "ETAG_MISMATCH") << "also once the object is of a later revision";
  EXPECT_EQ(Clone(ball_, seen.etag()), "ETAG_MISMATCH");
  EXPECT_EQ(Delete(ball_, seen.etag()), "ETAG_MISMATCH");
  EXPECT_EQ(Rename(ball_, "mine", ball_.etag()), "OK");
}

}  // namespace
}  // namespace dhpmap::testing
