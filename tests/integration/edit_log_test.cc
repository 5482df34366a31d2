// SPDX-License-Identifier: BSD-3-Clause
// Retried edits, and the log of all edits.
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "storage/sqlite_store.h"
#include "tests/integration/tcp_proxy.h"
#include "tests/integration/test_server.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

std::string Uuid(int number) {
  std::string text = "00000000-0000-4000-8000-000000000000";
  const std::string digits = std::to_string(number);
  return text.replace(text.size() - digits.size(), digits.size(), digits);
}

/// A mapped room in a database file, whose server can be restarted.
class EditLogTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Start();
    ASSERT_OK(server->Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(*server, "room", 0, 6));
  }
  void Start() {
    auto opened = OpenSqliteStore((folder.path() / "maps.db").string());
    ASSERT_OK(opened);
    store = std::move(opened).value();
    OpenMapOptions session;
    session.now_ns = [this] { return now_ns.load(); };
    server = std::make_unique<TestServer>(*store, session);
  }
  void Stop() {
    ASSERT_OK(server->Stop());
    server = nullptr;
    store = nullptr;
  }
  std::int64_t Revision() { return (*store->LoadMap("room"))->revision(); }

  static v1::ApplyEditsRequest Rename(const std::string& name, const std::string& request_id) {
    v1::ApplyEditsRequest request;
    request.set_map("maps/room");
    request.set_request_id(request_id);
    request.set_author("anna");
    v1::Edit& edit = *request.add_edits();
    edit.set_submap("maps/room/submaps/1");
    edit.mutable_rename()->set_display_name(name);
    return request;
  }
  v1::ApplyEditsResponse Apply(const v1::ApplyEditsRequest& request) {
    return server->Call(&EditStub::ApplyEdits, request).KeepStatus(status);
  }
  v1::CloneSubmapResponse Clone(const v1::CloneSubmapRequest& request) {
    return server->Call(&SubmapStub::CloneSubmap, request).KeepStatus(status);
  }
  std::vector<v1::LoggedEdit> Log(const std::string& author = "", int page_size = 0) {
    std::vector<v1::LoggedEdit> log;
    v1::ListEditsRequest request;
    request.set_parent("maps/room");
    request.set_author(author);
    request.set_page_size(page_size);
    do {
      const v1::ListEditsResponse page = server->Call(&EditStub::ListEdits, request).value();
      log.insert(log.end(), page.edits().begin(), page.edits().end());
      request.set_page_token(page.next_page_token());
    } while (!request.page_token().empty());
    return log;
  }

  TempDir folder;
  std::unique_ptr<MapStore> store;
  std::unique_ptr<TestServer> server;
  grpc::Status status;
  std::atomic<std::int64_t> now_ns = 1'800'000'000'000'000'000;  ///< the system's clock
};

TEST_F(EditLogTest, ARetryGetsTheSameAnswerAndIsMadeOnce) {
  v1::CloneSubmapRequest request;
  request.set_name("maps/room/submaps/1");
  request.set_request_id(Uuid(1));
  const v1::CloneSubmapResponse first = Clone(request);
  ASSERT_OK(status);
  const std::int64_t revision = Revision();
  EXPECT_EQ(Clone(request).SerializeAsString(), first.SerializeAsString());
  ASSERT_OK(Feed(*server, "room", 6, 8));
  EXPECT_EQ(Clone(request).SerializeAsString(), first.SerializeAsString()) << "whatever became of the map since";
  Stop();
  Start();
  EXPECT_EQ(Clone(request).SerializeAsString(), first.SerializeAsString()) << "across a restart";
  EXPECT_GE(Revision(), revision);
  EXPECT_EQ(Log().size(), 1u);
}

TEST_F(EditLogTest, ARetryIsMadeOnceEvenIfTheClockWasSetMeanwhile) {
  constexpr std::int64_t kDay_ns = 86'400'000'000'000;
  const v1::ApplyEditsRequest request = Rename("lamp", Uuid(1));
  const v1::ApplyEditsResponse first = Apply(request);
  ASSERT_TRUE(status.ok()) << status.error_message();
  for (const std::int64_t step_ns : {400 * kDay_ns, -800 * kDay_ns}) {
    now_ns += step_ns;
    (void)Apply(Rename("another" + std::to_string(step_ns), Uuid(step_ns > 0 ? 2 : 3)));
    ASSERT_TRUE(status.ok()) << status.error_message();
    EXPECT_EQ(Apply(request).SerializeAsString(), first.SerializeAsString());
    Stop();
    now_ns += step_ns;
    Start();
    EXPECT_EQ(Apply(request).SerializeAsString(), first.SerializeAsString()) << "across a restart";
  }
  const std::vector<v1::LoggedEdit> log = Log();
  EXPECT_EQ(log.size(), 3u);
  for (const v1::LoggedEdit& edit : log) EXPECT_TRUE(edit.reversible()) << edit.revision();
}

TEST_F(EditLogTest, ARetrysEtagIsNotChecked) {
  v1::ApplyEditsRequest request = Rename("lamp", Uuid(2));
  ASSERT_OK_AND_ASSIGN(const auto got, server->Call(&SubmapStub::GetSubmap, "maps/room/submaps/1"));
  request.mutable_edits(0)->set_etag(got.submap().etag());
  const v1::ApplyEditsResponse first = Apply(request);
  ASSERT_OK(status);
  const v1::ApplyEditsResponse second = Apply(request);
  EXPECT_OK(status);
  EXPECT_EQ(second.SerializeAsString(), first.SerializeAsString());
}

TEST_F(EditLogTest, AnotherRequestWithTheSameIdIsRefused) {
  Apply(Rename("lamp", Uuid(3)));
  ASSERT_OK(status);
  const std::int64_t revision = Revision();
  Apply(Rename("sofa", Uuid(3)));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(ReasonOf(status), "REQUEST_ID_REUSED");
  v1::CloneSubmapRequest clone;
  clone.set_name("maps/room/submaps/1");
  clone.set_request_id(Uuid(3));
  Clone(clone);
  EXPECT_EQ(ReasonOf(status), "REQUEST_ID_REUSED") << "of another method, too";
  EXPECT_EQ(Revision(), revision);
  Apply(Rename("sofa", "no-uuid"));
  EXPECT_EQ(ReasonOf(status), "BAD_REQUEST_ID");
  v1::ApplyEditsRequest long_name = Rename("sofa", "");
  long_name.set_author(std::string(300, 'a'));
  Apply(long_name);
  EXPECT_EQ(ReasonOf(status), "BAD_AUTHOR");
}

TEST_F(EditLogTest, IsListedByObject) {
  for (int i = 0; i < 3; ++i) {
    Apply(Rename("lamp " + std::to_string(i), ""));
    v1::ApplyEditsRequest other = Rename("table " + std::to_string(i), "");
    other.mutable_edits(0)->set_submap("maps/room/submaps/2");
    Apply(other);
    ASSERT_OK(status);
  }
  v1::ListEditsRequest request;
  request.set_parent("maps/room");
  request.set_submap("maps/room/submaps/1");
  request.set_page_size(2);
  std::vector<std::int64_t> listed, expected;
  do {
    const v1::ListEditsResponse page = server->Call(&EditStub::ListEdits, request).value();
    for (const v1::LoggedEdit& edit : page.edits()) listed.push_back(edit.revision());
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  for (const v1::LoggedEdit& edit : Log()) {
    if (edit.changed_submaps(0) == request.submap()) expected.push_back(edit.revision());
  }
  EXPECT_EQ(expected.size(), 3u);
  EXPECT_EQ(listed, expected);
  request.set_submap("maps/other/submaps/1");
  EXPECT_EQ(server->Call(&EditStub::ListEdits, request).reason(), "BAD_FILTER");
}

TEST_F(EditLogTest, AFailedOrTriedEditLeavesItsIdFree) {
  v1::ApplyEditsRequest request = Rename("lamp", Uuid(4));
  request.mutable_edits(0)->set_submap("maps/room/submaps/99");
  Apply(request);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::NOT_FOUND);
  Apply(Rename("lamp", Uuid(4)));
  EXPECT_OK(status) << "the id is free";
  v1::ApplyEditsRequest tried = Rename("sofa", Uuid(5));
  tried.set_validate_only(true);
  Apply(tried);
  ASSERT_OK(status);
  EXPECT_EQ(Log().size(), 1u) << "what was only tried is no edit";
}

TEST_F(EditLogTest, TheSecondOfTwoEqualRequestsWaitsForTheFirst) {
  std::vector<std::future<std::string>> answers;
  for (int i = 0; i < 8; ++i) {
    answers.push_back(std::async(std::launch::async, [this] {
      v1::CloneSubmapRequest request;
      request.set_name("maps/room/submaps/1");
      request.set_request_id(Uuid(6));
      const auto answer = server->Call(&SubmapStub::CloneSubmap, request);
      return answer.ok() ? answer->SerializeAsString() : answer.status().error_message();
    }));
  }
  std::set<std::string> different;
  for (auto& answer : answers) different.insert(answer.get());
  EXPECT_EQ(different.size(), 1u);
  EXPECT_EQ(Log().size(), 1u);
}

TEST_F(EditLogTest, TheLogNamesAuthorsAndActionsAndIsPaged) {
  v1::ApplyEditsRequest list = Rename("lamp", Uuid(7));
  v1::Edit& clone = *list.add_edits();
  clone.set_submap("maps/room/submaps/1");
  clone.mutable_clone();
  v1::Edit& gone = *list.add_edits();
  gone.set_submap("#1");
  gone.mutable_delete_();
  Apply(list);
  ASSERT_OK(status);
  for (int i = 0; i < 4; ++i) Apply(Rename(std::to_string(i), Uuid(10 + i)));
  const auto log = Log("", 2);
  ASSERT_EQ(log.size(), 5u);
  const v1::LoggedEdit& oldest = log.back();
  EXPECT_EQ(oldest.name(), "maps/room/edits/" + std::to_string(oldest.revision()));
  EXPECT_EQ(oldest.author(), "anna");
  EXPECT_EQ(oldest.request_id(), Uuid(7));
  EXPECT_EQ(oldest.kind(), v1::LoggedEdit::EDIT);
  ASSERT_EQ(oldest.steps_size(), 3);
  EXPECT_EQ(oldest.steps(0).action(), v1::LoggedEdit::RENAME);
  EXPECT_EQ(oldest.steps(1).action(), v1::LoggedEdit::CLONE);
  EXPECT_EQ(oldest.steps(2).action(), v1::LoggedEdit::DELETE);
  EXPECT_EQ(oldest.changed_submaps_size(), 1);
  EXPECT_EQ(oldest.created_submaps_size() + oldest.removed_submaps_size(), 0) << "what came and went within the list";
  for (std::size_t i = 1; i < log.size(); ++i) EXPECT_EQ(log[i].revision(), log[i - 1].revision() - 1);
  EXPECT_TRUE(Log("ben").empty());
}

TEST_F(EditLogTest, AnUndoIsAnEditAndIsSafelyRetried) {
  Apply(Rename("lamp", ""));
  Apply(Rename("sofa", ""));
  v1::UndoEditsRequest undo;
  undo.set_map("maps/room");
  undo.set_author("anna");
  undo.set_request_id(Uuid(50));
  std::string answer;
  for (int round = 0; round < 2; ++round) {
    ASSERT_OK_AND_ASSIGN(const auto response, server->Call(&EditStub::UndoEdits, undo));
    EXPECT_EQ(response.edits_size(), 1);
    EXPECT_EQ(response.changed_submaps_size(), 1);
    if (round == 1) {
      EXPECT_EQ(response.SerializeAsString(), answer) << "undone once";
    }
    answer = response.SerializeAsString();
    if (round == 0) Stop(), Start();
  }
  EXPECT_EQ((*store->LoadMap("room"))->Find(SubmapId(1))->info().display_name, "lamp");
  const auto log = Log();
  ASSERT_EQ(log.size(), 3u);
  EXPECT_EQ(log[0].kind(), v1::LoggedEdit::UNDO);
  ASSERT_EQ(log[0].targets_size(), 1);
  EXPECT_EQ(log[0].targets(0), log[1].name());
  EXPECT_TRUE(log[1].undone() && log[1].reversible());
  undo.clear_request_id();
  undo.set_edit(log[1].name());
  EXPECT_EQ(server->Call(&EditStub::UndoEdits, undo).reason(), "NOTHING_TO_UNDO");
}

TEST_F(EditLogTest, AnUndoKeepsWhatMappingHasAddedSince) {
  v1::DeleteSubmapRequest gone;
  gone.set_name("maps/room/submaps/1");
  gone.set_author("anna");
  ASSERT_OK(server->Call(&SubmapStub::DeleteSubmap, gone));
  ASSERT_OK(Feed(*server, "room", 6, 12));
  const std::size_t num_submaps = (*store->LoadMap("room"))->submaps().size();
  ASSERT_OK_AND_ASSIGN(const auto response, server->Call(&SubmapStub::UndeleteSubmap, gone.name()));
  EXPECT_EQ(response.submap().name(), gone.name());
  EXPECT_EQ((*store->LoadMap("room"))->submaps().size(), num_submaps + 1);
  ASSERT_OK(Feed(*server, "room", 12, 15)) << "mapping goes on";
  const auto report = store->VerifyMap("room", false, {});
  ASSERT_OK(report);
  EXPECT_EQ(report->num_faults, 0);
}

/// Each edit is applied once: every rename that is made adds a revision.
TEST_F(EditLogTest, AThousandRetriedEditsOverAnUnreliableLinkAreEachMadeOnce) {
  constexpr int kNumEdits = 1000;
  std::mt19937 random(5);
  const std::int64_t before = Revision();
  auto proxy = std::make_unique<CuttingProxy>(server->grpc().port(), random());
  int num_lost = 0;
  std::shared_ptr<grpc::Channel> channel;
  for (int i = 0; i < kNumEdits; ++i) {
    if (i == kNumEdits / 2) {  // ids survive a restart
      channel = nullptr;
      proxy = nullptr;
      Stop();
      Start();
      proxy = std::make_unique<CuttingProxy>(server->grpc().port(), random());
    }
    const v1::ApplyEditsRequest request = Rename("name " + std::to_string(i), Uuid(100 + i));
    for (bool is_done = false; !is_done;) {
      if (channel == nullptr) {
        grpc::ChannelArguments own;
        own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
        own.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
        channel = grpc::CreateCustomChannel(proxy->address(), grpc::InsecureChannelCredentials(), own);
      }
      const auto done = Client(channel).Call(&EditStub::ApplyEdits, request);
      is_done = done.ok();
      if (is_done) {
        ASSERT_EQ(done->revision(), before + i + 1);
      } else {
        ASSERT_EQ(done.code(), grpc::StatusCode::UNAVAILABLE) << done.status().error_message();
        ++num_lost;
        channel = nullptr;
      }
    }
  }
  EXPECT_GT(num_lost, kNumEdits / 20) << "the link was cut";
  EXPECT_EQ(Revision(), before + kNumEdits);
  std::set<std::string> ids;
  for (const v1::LoggedEdit& edit : Log()) ids.insert(edit.request_id());
  EXPECT_EQ(ids.size(), static_cast<std::size_t>(kNumEdits));
}

}  // namespace
}  // namespace dhpmap::testing
