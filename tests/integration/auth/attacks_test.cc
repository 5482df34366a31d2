// SPDX-License-Identifier: BSD-3-Clause
// Attacks by clients without a key and with one, and the answers to them.
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "dhpmap/v1/auth_service.grpc.pb.h"
#include "tests/integration/auth/locked_server.h"

namespace dhpmap::testing {
namespace {

using AuthStub = v1::AuthService::Stub;

class Attacks : public ::testing::Test {
 protected:
  /// Creates a map as the robot.
  void Create(const std::string& id) {
    ASSERT_OK(locked.Call(locked.key_of("robot"), &MapStub::CreateMap, CreateRequest(id)));
  }
  static std::string Same(const http::HttpAnswer& answer) { return std::to_string(answer.status) + answer.body; }

  LockedServer locked;
};

TEST_F(Attacks, AnswersDistinguishOnlyAMissingKeyFromAnInvalidOne) {
  const std::string viewer = locked.key_of("viewer");
  std::string unknown = auth::MakeKeyText(auth::SystemRandomness());
  const auto asked = [&](const std::string& key) { return locked.Ask(key, "GET", "/v1/maps"); };
  EXPECT_EQ(asked(viewer).status, 200);
  const http::HttpAnswer none = asked("");
  EXPECT_EQ(none.status, 401);
  EXPECT_EQ(none.Header("WWW-Authenticate"), "Bearer realm=\"dhpmap\"");
  EXPECT_NE(none.body.find("NO_CREDENTIAL"), std::string::npos);
  EXPECT_NE(asked(unknown).body.find("BAD_CREDENTIAL"), std::string::npos);
  EXPECT_EQ(Same(asked(unknown)), Same(asked(viewer.substr(0, 40))));
  EXPECT_EQ(Same(asked(unknown)), Same(asked("x")));
  const auto over_grpc = [&](const std::string& key) { return locked.Call(key, &MapStub::ListMaps).status(); };
  EXPECT_EQ(over_grpc("").error_code(), grpc::UNAUTHENTICATED);
  EXPECT_EQ(over_grpc("").error_message().substr(0, 14), "NO_CREDENTIAL:");
  EXPECT_EQ(over_grpc(unknown).error_code(), grpc::UNAUTHENTICATED);
  EXPECT_EQ(over_grpc(unknown).error_message(), over_grpc("x").error_message());
}

TEST_F(Attacks, WrongKeysAreThrottledByAddressOverBothDoorsAndLockNoOneElseOut) {
  const auto over_grpc = [&](const std::string& key) { return locked.Call(key, &MapStub::ListMaps).status(); };
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(locked.Ask("x", "GET", "/v1/maps").status, 401);
    EXPECT_EQ(over_grpc("x").error_code(), grpc::UNAUTHENTICATED);
  }
  const grpc::Status throttled = over_grpc("x");
  EXPECT_EQ(throttled.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(throttled.error_message().substr(0, 16), "TOO_MANY_LOGINS:");
  for (const char* page : {"/v1/maps", "/metrics"}) {
    const http::HttpAnswer answer = locked.Ask("x", "GET", page);
    EXPECT_EQ(answer.status, 429);
    EXPECT_NE(answer.body.find("TOO_MANY_LOGINS"), std::string::npos);
    EXPECT_NE(answer.body.find("google.rpc.RetryInfo"), std::string::npos);
    EXPECT_TRUE(answer.Header("Retry-After") == "3" || answer.Header("Retry-After") == "2") << "as it is waited";
  }
  EXPECT_EQ(locked.Ask("x", "POST", "/ui/login").status, 429);
  EXPECT_EQ(locked.Ask(locked.key_of("viewer"), "GET", "/v1/maps").status, 200);
  EXPECT_OK(over_grpc(locked.key_of("viewer")));
}

TEST_F(Attacks, TwoKeysOverOneConnectionAreTwoCallers) {
  std::vector<std::thread> threads;
  for (const char* role : {"viewer", "admin", "robot"}) {
    threads.emplace_back([this, role] {
      for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(locked.Call(locked.key_of(role), &AuthStub::WhoAmI)->principal(), role);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_NE(locked.Ask(locked.key_of("editor"), "GET", "/v1/whoami").body.find("\"principal\":\"editor\""),
            std::string::npos);
}

TEST_F(Attacks, TicketsAndNamesFromOutsideAreIgnored) {
  const std::string path = "/dhpmap.v1.MapService/ListMaps";
  const auto ticket = locked.gate().tickets().Issue(*locked.gate().AuthenticateKey(locked.key_of("admin")));
  const auto channel = locked.server().channel();
  EXPECT_EQ(CallRawAs(channel, path, "", {{"dhpmap-ticket", ticket->text()}}).error_code(), grpc::UNAUTHENTICATED);
  EXPECT_EQ(CallRawAs(channel, path, locked.key_of("admin"), {{"dhpmap-ticket", ticket->text()}}).error_code(),
            grpc::UNAUTHENTICATED);
  EXPECT_EQ(CallRawAs(channel, path, "", {{"x-dhpmap-principal", "admin"}}).error_code(), grpc::UNAUTHENTICATED);
  EXPECT_EQ(locked.Ask("", "GET", "/v1/maps", "", {{"dhpmap-ticket", ticket->text()}}).status, 401);
  EXPECT_EQ(locked.Ask(locked.key_of("viewer"), "DELETE", "/v1/maps/a", "", {{"dhpmap-ticket", ticket->text()}}).status,
            403);
  const auto inside = locked.server().grpc().InProcessChannel();
  EXPECT_EQ(CallRawAs(inside, path, "").error_code(), grpc::UNAUTHENTICATED) << "no processor looks at calls inside";
}

TEST_F(Attacks, KeysInUrlsAndTwoKeysAtOnceAreRefused) {
  const std::string key = locked.key_of("admin");
  for (const std::string& target :
       {"/v1/maps?access_token=" + key, "/v1/maps?x=" + key, std::string("/metrics?access_token=x")}) {
    const http::HttpAnswer answer = locked.Ask("", "GET", target);
    EXPECT_EQ(answer.status, 400) << target;
    EXPECT_NE(answer.body.find("TOKEN_IN_URL"), std::string::npos);
    EXPECT_EQ(answer.body.find(key), std::string::npos) << "nor does the answer hold it";
  }
  const http::HttpAnswer twice = locked.Ask(key, "GET", "/v1/maps", "", {{"authorization", "Bearer " + key}});
  EXPECT_EQ(twice.status, 400);
  EXPECT_NE(twice.body.find("AMBIGUOUS_CREDENTIAL"), std::string::npos);
}

TEST_F(Attacks, AllPagesExceptHealthNeedAKey) {
  for (const char* page : {"/", "/metrics", "/openapi.json"}) {
    EXPECT_EQ(locked.Ask("", "GET", page).status, 401) << page;
    EXPECT_EQ(locked.Ask(locked.key_of("viewer"), "GET", page).status, 200) << page;
  }
  const std::string narrow = locked.MakeKey({.name = "narrow", .maps = {"site-*"}});
  EXPECT_EQ(locked.Ask(narrow, "GET", "/metrics").status, 403) << "they name all maps";
  EXPECT_EQ(locked.Ask(narrow, "GET", "/openapi.json").status, 200);
  for (const char* page : {"/healthz", "/readyz"}) EXPECT_EQ(locked.Ask("", "GET", page).status, 200) << page;
}

TEST_F(Attacks, AForbiddenMapLooksLikeAMissingOne) {
  Create("site-a");
  Create("home");
  const std::string narrow = locked.MakeKey({.name = "n", .role = auth::Role::kAdmin, .maps = {"site-*", "!site-x"}});
  const auto over_grpc = [&](const char* map) {
    const auto answer = locked.Call(narrow, &MapStub::GetMap, About<v1::GetMapRequest>(map));
    return std::to_string(answer.code()) + answer.reason() + answer.status().error_message();
  };
  EXPECT_EQ(over_grpc("maps/site-a"), "0");
  EXPECT_EQ(over_grpc("maps/home"), over_grpc("maps/nowhere"));
  EXPECT_EQ(over_grpc("maps/home"), over_grpc("maps/site-x"));
  const auto over_rest = [&](const std::string& map) { return Same(locked.Ask(narrow, "GET", "/v1/maps/" + map)); };
  EXPECT_EQ(over_rest("home").substr(0, 3), "403");
  EXPECT_EQ(over_rest("home"), over_rest("nowhere"));
  EXPECT_EQ(over_rest("%68ome"), over_rest("home")) << "however it is written";
  EXPECT_EQ(locked.Ask(narrow, "POST", "/v1/maps", R"({"mapId": "home2"})").status, 403);
  EXPECT_EQ(locked.Ask(narrow, "GET", "/v1/maps:backup").status, 403) << "of all maps";
}

TEST_F(Attacks, ListsOmitForbiddenMapsOnEachPage) {
  for (const char* id : {"a", "b-1", "b-2", "c", "b-3", "d"}) Create(id);
  const std::string narrow = locked.MakeKey({.name = "n", .maps = {"b-*", "d"}});
  std::vector<std::string> seen;
  v1::ListMapsRequest request;
  request.set_page_size(1);
  do {
    const auto page = locked.Call(narrow, &MapStub::ListMaps, request);
    ASSERT_OK(page);
    for (const v1::Map& map : page->maps()) seen.push_back(map.name());
    request.set_page_token(page->next_page_token());
  } while (!request.page_token().empty() && seen.size() < 10);
  EXPECT_EQ(seen, (std::vector<std::string>{"maps/b-1", "maps/b-2", "maps/b-3", "maps/d"}));
}

TEST_F(Attacks, AStreamOfQueriesChecksTheMapOfEachMessage) {
  Create("a");
  Create("b");
  const std::string narrow = locked.MakeKey({.name = "n", .maps = {"a"}});
  grpc::ClientContext context;
  LockedServer::Show(narrow, context);
  const auto stream = locked.server().queries->StreamQueries(&context);
  const auto ask = [&](const char* map) {
    v1::StreamQueriesRequest request;
    request.mutable_query_relations()->set_map(map);
    v1::StreamQueriesResponse answer;
    EXPECT_TRUE(stream->Write(request) && stream->Read(&answer));
    return ReasonOf(answer.error());
  };
  EXPECT_EQ(ask("maps/a"), "");
  EXPECT_EQ(ask("maps/b"), "MAP_NOT_ALLOWED");
  EXPECT_EQ(ask("maps/a"), "") << "and it goes on";
  stream->WritesDone();
  EXPECT_OK(stream->Finish());
}

TEST_F(Attacks, AnEditBelongsToItsAuthor) {
  Create("a");
  const std::string anna = locked.MakeKey({.name = "anna", .role = auth::Role::kEditor});
  const std::string bert = locked.MakeKey({.name = "bert", .role = auth::Role::kEditor});
  v1::ApplyEditsRequest edit;
  edit.set_map("maps/a");
  edit.set_request_id("01234567-89ab-cdef-0123-456789abcdef");
  edit.add_edits()->mutable_ignore_region()->set_name("door");
  auto& sphere = *edit.mutable_edits(0)->mutable_ignore_region()->mutable_sphere();
  sphere.mutable_center_m()->set_x(1);
  sphere.set_radius_m(1);
  v1::ApplyEditsRequest foreign = edit;
  foreign.set_author("anna");
  EXPECT_EQ(locked.Call(bert, &EditStub::ApplyEdits, foreign).reason(), "NOT_YOUR_NAME");
  const auto made = locked.Call(anna, &EditStub::ApplyEdits, edit);
  ASSERT_OK(made);
  EXPECT_EQ(locked.Call(anna, &EditStub::ApplyEdits, edit)->revision(), made->revision()) << "sent again";
  EXPECT_EQ(locked.Call(bert, &EditStub::ApplyEdits, edit).reason(), "REQUEST_ID_REUSED") << "by another";
  const auto log = locked.Call(bert, &EditStub::ListEdits, About<v1::ListEditsRequest>("maps/a"));
  ASSERT_OK(log);
  ASSERT_EQ(log->edits_size(), 1);
  EXPECT_EQ(log->edits(0).author(), "anna") << "who said no name";
  v1::UndoEditsRequest undo;
  undo.set_map("maps/a");
  EXPECT_EQ(locked.Call(bert, &EditStub::UndoEdits, undo).reason(), "NOTHING_TO_UNDO");
  undo.set_edit(log->edits(0).name());
  EXPECT_EQ(locked.Call(bert, &EditStub::UndoEdits, undo).reason(), "NOT_YOUR_NAME");
  EXPECT_OK(locked.Call(anna, &EditStub::UndoEdits, undo));
  v1::RestoreRevisionRequest back;
  back.set_map("maps/a");
  back.set_revision(made->revision() - 1);
  EXPECT_EQ(locked.Call(bert, &EditStub::RestoreRevision, back).reason(), "NOT_YOUR_NAME") << "which undoes it, too";
  EXPECT_OK(locked.Call(anna, &EditStub::RestoreRevision, back));
}

TEST_F(Attacks, AViewerMayOnlyTryEdits) {
  Create("a");
  const std::string path = "/v1/maps/a:applyEdits", edits = R"("edits": [{"ignoreRegion": {"name": "d", "sphere":
      {"centerM": {"x": 1}, "radiusM": 1}}}])";
  const std::string viewer = locked.key_of("viewer");
  EXPECT_EQ(locked.Ask(viewer, "POST", path, "{" + edits + "}").status, 403);
  EXPECT_EQ(locked.Ask(viewer, "POST", path, R"({"validateOnly": true, )" + edits + "}").status, 200);
  EXPECT_EQ(locked.Ask(viewer, "POST", path, R"({"validateOnly": false, )" + edits + "}").status, 403);
  EXPECT_EQ(locked.Ask(viewer, "POST", path, R"({"validateOnly": true, "validateOnly": false, )" + edits + "}").status,
            400)
      << "one or the other";
  EXPECT_EQ(locked.Call(viewer, &MapStub::GetMap, About<v1::GetMapRequest>("maps/a"))->revision(), 1);
}

TEST_F(Attacks, ARobotMayFeedAndEndOnlyItsOwnSession) {
  Create("a");
  const std::string spot = locked.MakeKey({.name = "spot", .role = auth::Role::kRobot});
  const auto feed = [&](const std::string& session) {
    grpc::ClientContext context;
    LockedServer::Show(spot, context);
    const auto stream = locked.server().mapping->IntegrateFrames(&context);
    v1::IntegrateFramesRequest hello;
    hello.set_map("maps/a");
    hello.set_session(session);
    stream->Write(hello);
    stream->WritesDone();
    v1::IntegrateFramesResponse answer;
    while (stream->Read(&answer)) {
    }
    return ReasonOf(stream->Finish());
  };
  EXPECT_EQ(feed("spot"), "");
  EXPECT_EQ(feed("robot"), "NOT_YOUR_SESSION");
  v1::EndSessionRequest end;
  end.set_map("maps/a");
  end.set_session("robot");
  EXPECT_EQ(locked.Call(spot, &MappingStub::EndSession, end).reason(), "NOT_YOUR_SESSION");
}

TEST_F(Attacks, ARobotMayRepeatTakeOverWithinItsStream) {
  Create("a");
  const std::string spot = locked.MakeKey({.name = "spot", .role = auth::Role::kRobot});
  grpc::ClientContext context;
  LockedServer::Show(spot, context);
  const auto stream = locked.server().mapping->IntegrateFrames(&context);
  v1::IntegrateFramesRequest message;
  message.set_map("maps/a");
  message.set_session("spot");
  message.set_take_over(true);
  ASSERT_TRUE(stream->Write(message));
  message.clear_session();  // later messages need not repeat it
  ASSERT_TRUE(stream->Write(message));
  stream->WritesDone();
  v1::IntegrateFramesResponse answer;
  while (stream->Read(&answer)) {
  }
  const std::string reason = ReasonOf(stream->Finish());
  EXPECT_NE(reason, "NOT_YOUR_SESSION");
}

TEST_F(Attacks, StreamsEndWhenTheirKeyIsRevoked) {
  Create("a");
  const std::string spot = locked.MakeKey({.name = "spot", .role = auth::Role::kRobot});
  grpc::ClientContext watching, asking, feeding;
  for (grpc::ClientContext* context : {&watching, &asking, &feeding}) LockedServer::Show(spot, *context);
  v1::WatchMapRequest watch;
  watch.set_map("maps/a");
  watch.set_start_revision(1);
  const auto changes = locked.server().watches->WatchMap(&watching, watch);
  v1::WatchMapResponse change;
  ASSERT_TRUE(changes->Read(&change)) << "it has begun";
  const auto queries = locked.server().queries->StreamQueries(&asking);
  v1::StreamQueriesRequest query;
  query.mutable_query_relations()->set_map("maps/a");
  v1::StreamQueriesResponse answer;
  ASSERT_TRUE(queries->Write(query) && queries->Read(&answer));
  const auto frames = locked.server().mapping->IntegrateFrames(&feeding);
  v1::IntegrateFramesRequest hello;
  hello.set_map("maps/a");
  hello.set_session("spot");
  v1::IntegrateFramesResponse ack;
  ASSERT_TRUE(frames->Write(hello) && frames->Read(&ack));
  http::HttpClient rest(locked.http_port());
  rest.SendRaw(
      "GET /v1/maps/a:watch?start_revision=1 HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nAuthorization: "
      "Bearer " +
      spot + "\r\n\r\n");
  ASSERT_NE(rest.ReadSome(), "");
  EXPECT_EQ(locked.gate().streams().size(), 4u);

  locked.Revoke("spot");
  while (changes->Read(&change)) {
  }
  EXPECT_EQ(changes->Finish().error_code(), grpc::UNAUTHENTICATED);
  while (queries->Read(&answer)) {
  }
  EXPECT_EQ(queries->Finish().error_code(), grpc::UNAUTHENTICATED);
  while (frames->Read(&ack)) {
  }
  EXPECT_EQ(frames->Finish().error_code(), grpc::UNAUTHENTICATED);
  while (!rest.ReadSome().empty()) {
  }
  EXPECT_TRUE(Eventually([&] { return locked.gate().streams().size() == 0; })) << "and their places are free";
  EXPECT_EQ(locked.Ask(spot, "GET", "/v1/maps").status, 401);
}

TEST_F(Attacks, OnlyHealthNeedsNoKey) {
  const auto channel = locked.server().channel();
  EXPECT_OK(CallRawAs(channel, "/grpc.health.v1.Health/Check", ""));
  EXPECT_EQ(CallRawAs(channel, "/grpc.health.v1.Health/Watch", "").error_code(), grpc::UNAUTHENTICATED);
  EXPECT_EQ(CallRawAs(channel, "/grpc.health.v1.Health/Watch", locked.key_of("admin")).error_code(),
            grpc::UNIMPLEMENTED)
      << "it would outlive its key";
  EXPECT_EQ(CallRawAs(channel, "/dhpmap.v1.MapService/NoSuch", "").error_code(), grpc::UNAUTHENTICATED);
  EXPECT_EQ(CallRawAs(channel, "/dhpmap.v1.MapService/NoSuch", locked.key_of("admin")).error_code(),
            grpc::UNIMPLEMENTED);
}

}  // namespace
}  // namespace dhpmap::testing
