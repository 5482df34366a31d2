// SPDX-License-Identifier: BSD-3-Clause
// `author`, `request_id`, `validate_only`, `etag` and `expected_revision` mean the same in every request that edits.
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/integration/test_server.h"
#include "tests/integration/test_store.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

/// The five fields.
struct AskedBeside {
  std::string author = "anna";
  std::string request_id = {};
  bool validate_only = false;
  std::string etag = {};
  std::int64_t expected_revision = 0;
};

/// The answer to a request, without the fields that differ between an edit and a trial.
struct EditAnswer {
  std::string outcome = {};  ///< "OK", or the reason
  std::int64_t revision = 0;
  std::string bytes = {};  ///< as received
  std::string told = {};   ///< without revisions, etags and times
};

/// A request that edits. Each is made after the earlier ones of the list.
struct EditingRequest {
  std::string name;
  std::string etag;  ///< valid for the edited object
  std::function<EditAnswer(const AskedBeside&)> ask;
};

std::string NumberedUuid(int number) {
  std::string text = "00000000-0000-4000-8000-000000000000";
  const std::string digits = std::to_string(number);
  return text.replace(text.size() - digits.size(), digits.size(), digits);
}

template <typename Request>
Request With(const AskedBeside& beside, Request request) {
  request.set_author(beside.author);
  request.set_request_id(beside.request_id);
  request.set_validate_only(beside.validate_only);
  request.set_expected_revision(beside.expected_revision);
  if constexpr (requires { request.set_etag(beside.etag); }) request.set_etag(beside.etag);
  return request;
}

template <typename Response>
EditAnswer AnswerOf(const grpc::Status& status, Response response) {
  if (!status.ok()) {
    const std::string reason = ReasonOf(status);
    return {.outcome = reason.empty() ? status.error_message() : reason};
  }
  EditAnswer answer{.outcome = "OK", .revision = response.revision(), .bytes = response.SerializeAsString()};
  response.clear_revision();
  if constexpr (requires { response.mutable_submap(); }) {
    if (response.has_submap()) response.mutable_submap()->clear_revision(), response.mutable_submap()->clear_etag();
  }
  if constexpr (requires { response.mutable_map()->clear_update_time(); }) {
    response.mutable_map()->clear_update_time();
    response.mutable_map()->clear_revision();
  }
  answer.told = response.SerializeAsString();
  return answer;
}

/// A mapped room in which ben has edited everything once, and anna the floor's name.
class EditFieldsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(server, "room", 0, 12));
    mapped_revision = Revision();
    const v1::ListSubmapsResponse listed = List();
    for (const v1::Submap& submap : listed.submaps()) {
      if (submap.class_id() == 1) ball = submap.name();
      if (submap.class_id() == 2) box = submap.name();
      if (submap.class_id() == 3) floor = submap.name();
    }
    ASSERT_FALSE(ball.empty() || box.empty() || floor.empty());
    for (const std::string& name : {ball, box, floor})
      ASSERT_EQ(Rename(name, "of ben", {.author = "ben"}).outcome, "OK");
    ASSERT_EQ(RenameMap("of ben", {.author = "ben"}).outcome, "OK");
  }

  v1::ListSubmapsResponse List() { return server.Call(&SubmapStub::ListSubmaps, "maps/room").value(); }
  v1::Map GetMap() { return server.Call(&MapStub::GetMap, "maps/room").value().map(); }
  std::string EtagNow(const std::string& name) {
    const v1::ListSubmapsResponse listed = List();
    for (const v1::Submap& submap : listed.submaps()) {
      if (submap.name() == name) return submap.etag();
    }
    return {};
  }
  std::int64_t Revision() { return (*store->LoadMap("room"))->revision(); }
  std::vector<v1::LoggedEdit> Log() {
    const auto response = server.Call(&EditStub::ListEdits, "maps/room").value();
    return {response.edits().begin(), response.edits().end()};
  }
  /// Everything that a client can read of the map.
  std::string State() {
    std::string state = List().SerializeAsString() + GetMap().SerializeAsString();
    for (const v1::LoggedEdit& edit : Log()) state += edit.SerializeAsString();
    return state;
  }

  EditAnswer Rename(const std::string& name, const std::string& title, const AskedBeside& beside) {
    auto request = With(beside, v1::UpdateSubmapRequest());
    request.mutable_submap()->set_name(name);
    request.mutable_submap()->set_etag(beside.etag);
    request.mutable_submap()->set_display_name(title);
    request.mutable_update_mask()->add_paths("display_name");
    return Ask(&SubmapStub::UpdateSubmap, request);
  }
  EditAnswer RenameMap(const std::string& title, const AskedBeside& beside) {
    auto request = With(beside, v1::UpdateMapRequest());
    request.mutable_map()->set_name("maps/room");
    request.mutable_map()->set_etag(beside.etag);
    request.mutable_map()->set_display_name(title);
    request.mutable_update_mask()->add_paths("display_name");
    return Ask(&MapStub::UpdateMap, request);
  }
  EditAnswer ApplyRename(const std::string& name, const std::string& title, const AskedBeside& beside) {
    auto request = With(beside, v1::ApplyEditsRequest());
    request.set_map("maps/room");
    request.add_edits()->set_submap(name);
    request.mutable_edits(0)->mutable_rename()->set_display_name(title);
    return Ask(&EditStub::ApplyEdits, request);
  }
  template <typename Stub, typename Request, typename Response>
  EditAnswer Ask(Client::Unary<Stub, Request, Response> method, const Request& request) {
    const auto answer = server.Call(method, request);
    return AnswerOf(answer.status(), *answer);
  }
  /// A request with only a name in `set`, and the five fields.
  template <typename Stub, typename Request, typename Response, typename Set>
  std::function<EditAnswer(const AskedBeside&)> Named(Client::Unary<Stub, Request, Response> method, Set set) {
    return [this, method, set](const AskedBeside& beside) {
      Request request = With(beside, Request());
      set(request);
      return Ask(method, request);
    };
  }

  /// Calls visit(request) for one request of each kind; visit must finally make the edit.
  void ForEachRequest(const std::function<void(const EditingRequest&)>& visit) {
    const auto run = [&](const std::string& name, const std::string& etag,
                         std::function<EditAnswer(const AskedBeside&)> ask) {
      SCOPED_TRACE(name);
      visit({name, etag, std::move(ask)});
    };
    run("UpdateSubmap", EtagNow(ball), [this](const AskedBeside& beside) { return Rename(ball, "lamp", beside); });
    run("CloneSubmap", EtagNow(ball),
        Named(&SubmapStub::CloneSubmap, [this](auto& request) { request.set_name(ball); }));
    const std::string before_its_end = EtagNow(box);
    run("DeleteSubmap", before_its_end,
        Named(&SubmapStub::DeleteSubmap, [this](auto& request) { request.set_name(box); }));
    run("UndeleteSubmap", before_its_end,
        Named(&SubmapStub::UndeleteSubmap, [this](auto& request) { request.set_name(box); }));
    run("ApplyEdits", GetMap().etag(),
        [this](const AskedBeside& beside) { return ApplyRename(floor, "carpet", beside); });
    const auto of_room = [](auto& request) { request.set_map("maps/room"); };
    run("UndoEdits", GetMap().etag(), Named(&EditStub::UndoEdits, of_room));
    run("RedoEdits", GetMap().etag(), Named(&EditStub::RedoEdits, of_room));
    run("UpdateMap", GetMap().etag(), [this](const AskedBeside& beside) { return RenameMap("home", beside); });
    run("RestoreRevision", GetMap().etag(), Named(&EditStub::RestoreRevision, [this](auto& request) {
          request.set_map("maps/room");
          request.set_revision(mapped_revision);
        }));
  }

  std::unique_ptr<MapStore> store = MakeTestStore();
  TestServer server{*store};
  std::string ball, box, floor;
  std::int64_t mapped_revision = 0;
};

TEST_F(EditFieldsTest, ATrialIsAnsweredLikeTheEditAndChangesNothing) {
  ForEachRequest([this](const EditingRequest& request) {
    const std::string before = State();
    const std::int64_t revision = Revision();
    const EditAnswer tried = request.ask({.request_id = NumberedUuid(1), .validate_only = true});
    ASSERT_EQ(tried.outcome, "OK");
    EXPECT_EQ(tried.revision, revision) << "the one that was looked at";
    EXPECT_EQ(State(), before);
    const EditAnswer made = request.ask({});
    ASSERT_EQ(made.outcome, "OK");
    EXPECT_EQ(made.revision, revision + 1);
    EXPECT_EQ(tried.told, made.told);
  });
}

TEST_F(EditFieldsTest, ATrialReturnsNoEtagThatALaterStateMayHave) {
  v1::UpdateSubmapRequest request;
  request.mutable_submap()->set_name(ball);
  request.mutable_submap()->set_display_name("lamp");
  request.mutable_update_mask()->add_paths("display_name");
  request.set_validate_only(true);
  ASSERT_OK_AND_ASSIGN(v1::UpdateSubmapResponse response, server.Call(&SubmapStub::UpdateSubmap, request));
  EXPECT_EQ(response.submap().display_name(), "lamp");
  EXPECT_EQ(response.submap().etag(), "");
  EXPECT_EQ(response.submap().revision(), 0);
  request.mutable_submap()->set_display_name("of ben");  // its present name
  ASSERT_OK_AND_ASSIGN(response, server.Call(&SubmapStub::UpdateSubmap, request));
  EXPECT_EQ(response.submap().etag(), EtagNow(ball)) << "what would not change keeps its own";
}

TEST_F(EditFieldsTest, ARepeatedRequestGetsTheSameAnswerAndIsLoggedOnceUnderItsAuthor) {
  int number = 10;
  ForEachRequest([&](const EditingRequest& request) {
    const std::string id = NumberedUuid(++number);
    const std::size_t num_logged = Log().size();
    const EditAnswer first = request.ask({.request_id = id});
    ASSERT_EQ(first.outcome, "OK");
    const EditAnswer again = request.ask({.request_id = id});
    EXPECT_EQ(again.outcome, "OK");
    EXPECT_EQ(again.bytes, first.bytes);
    const auto log = Log();
    ASSERT_EQ(log.size(), num_logged + 1);
    EXPECT_EQ(log.front().author(), "anna");
    EXPECT_EQ(log.front().request_id(), id);
    EXPECT_EQ(log.front().revision(), first.revision);
    EXPECT_EQ(request.ask({.author = "ben", .request_id = id}).outcome, "REQUEST_ID_REUSED");
    EXPECT_EQ(request.ask({.request_id = "no-uuid"}).outcome, "BAD_REQUEST_ID");
    EXPECT_EQ(request.ask({.author = std::string(257, 'a')}).outcome, "BAD_AUTHOR");
  });
}

TEST_F(EditFieldsTest, AnEditWithAnOldEtagIsNotMade) {
  ForEachRequest([this](const EditingRequest& request) {
    const std::string before = State();
    EXPECT_EQ(request.ask({.etag = "0123456789abcdef-r1"}).outcome, "ETAG_MISMATCH");
    EXPECT_EQ(request.ask({.validate_only = true, .etag = "0123456789abcdef-r1"}).outcome, "ETAG_MISMATCH");
    EXPECT_EQ(State(), before);
    EXPECT_EQ(request.ask({.etag = request.etag}).outcome, "OK");
  });
}

TEST_F(EditFieldsTest, AnEditWithAnOldExpectedRevisionIsNotMade) {
  ForEachRequest([this](const EditingRequest& request) {
    const std::string before = State();
    EXPECT_EQ(request.ask({.expected_revision = mapped_revision}).outcome, "EDITED_SINCE") << "by ben or anna";
    EXPECT_EQ(request.ask({.validate_only = true, .expected_revision = mapped_revision}).outcome, "EDITED_SINCE");
    EXPECT_EQ(request.ask({.expected_revision = Revision() + 1}).outcome, "EDITED_SINCE") << "not there yet";
    EXPECT_EQ(State(), before);
    EXPECT_EQ(request.ask({.expected_revision = Revision()}).outcome, "OK");
  });
}

TEST_F(EditFieldsTest, ANegativeExpectedRevisionIsInvalid) {
  ForEachRequest([this](const EditingRequest& request) {
    const std::string before = State();
    EXPECT_EQ(request.ask({.expected_revision = -1}).outcome, "BAD_EDIT");
    EXPECT_EQ(request.ask({.validate_only = true, .expected_revision = -1}).outcome, "BAD_EDIT");
    EXPECT_EQ(State(), before);
    EXPECT_EQ(request.ask({}).outcome, "OK");
  });
}

TEST_F(EditFieldsTest, FramesAndEditsOfOtherObjectsDoNotCount) {
  ASSERT_EQ(ApplyRename(floor, "carpet", {}).outcome, "OK");
  const std::int64_t known = Revision();
  ASSERT_OK(Feed(server, "room", 12, 16));
  ASSERT_EQ(Rename(ball, "of ben again", {.author = "ben"}).outcome, "OK");
  v1::UndoEditsRequest undo = With({.expected_revision = known}, v1::UndoEditsRequest());
  undo.set_map("maps/room");
  EXPECT_EQ(Ask(&EditStub::UndoEdits, undo).outcome, "OK");
  EXPECT_EQ(Rename(box, "crate", {.expected_revision = known}).outcome, "OK");
  EXPECT_EQ(RenameMap("home", {.expected_revision = known}).outcome, "OK");
  EXPECT_EQ(RenameMap("away", {.expected_revision = known}).outcome, "EDITED_SINCE");
}

TEST_F(EditFieldsTest, UndoingARenameOfTheMapIsAnEditOfTheMap) {
  ASSERT_EQ(RenameMap("home", {}).outcome, "OK");
  const std::int64_t known = Revision();
  v1::UndoEditsRequest undo = With({}, v1::UndoEditsRequest());
  undo.set_map("maps/room");
  ASSERT_EQ(Ask(&EditStub::UndoEdits, undo).outcome, "OK");
  EXPECT_EQ(RenameMap("away", {.expected_revision = known}).outcome, "EDITED_SINCE");
  EXPECT_EQ(RenameMap("away", {.expected_revision = Revision()}).outcome, "OK");
}

}  // namespace
}  // namespace dhpmap::testing
