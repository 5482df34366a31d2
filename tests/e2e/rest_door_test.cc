// SPDX-License-Identifier: BSD-3-Clause
// What people and robots meet at the REST door of a real server.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "tests/e2e/rest_fixture.h"
#include "tests/integration/feeder.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

bool ContainsText(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string FirstViolationOf(const grpc::Status& status) {
  google::rpc::Status details;
  google::rpc::BadRequest bad;
  const bool has_fields = details.ParseFromString(status.error_details()) && details.details_size() > 0 &&
                          details.details(details.details_size() - 1).UnpackTo(&bad) && bad.field_violations_size() > 0;
  return has_fields ? bad.field_violations(0).field() : "";
}

// Names of classes.

class ClassNames : public RestTest {
 protected:
  /// Both doors refuse the map for this field.
  void ExpectRefused(const v1::CreateMapRequest& request, const std::string& field) {
    SCOPED_TRACE(field);
    const http::HttpAnswer answer = Ask("POST", "/v1/maps", JsonOf(request));
    EXPECT_EQ(answer.status, 400) << answer.body.substr(0, 500);
    EXPECT_TRUE(ContainsText(answer.body, "BAD_MAP")) << answer.body.substr(0, 500);
    EXPECT_TRUE(ContainsText(answer.body, "\"" + field + "\"")) << answer.body.substr(0, 500);
    const grpc::Status status = CreateOverGrpc(request);
    EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT) << status.error_message();
    EXPECT_EQ(ReasonOf(status), "BAD_MAP");
    EXPECT_EQ(FirstViolationOf(status), field);
    EXPECT_EQ(Ask("GET", "/v1/" + NameOf(request)).status, 404) << "nothing was made";
  }
  void ExpectTaken(v1::CreateMapRequest request) {
    const http::HttpAnswer answer = Ask("POST", "/v1/maps", JsonOf(request));
    EXPECT_EQ(answer.status, 200) << answer.body;
    const auto map = Get<v1::GetMapResponse>(NameOf(request)).map();
    ASSERT_EQ(map.label_classes_size(), request.label_classes_size());
    for (int i = 0; i < map.label_classes_size(); ++i) {
      EXPECT_EQ(map.label_classes(i).name(), request.label_classes(i).name());
    }
    request.set_map_id(request.map_id() + "-over-grpc");
    const grpc::Status status = CreateOverGrpc(request);
    EXPECT_TRUE(status.ok()) << status.error_message();
  }

 private:
  grpc::Status CreateOverGrpc(const v1::CreateMapRequest& request) {
    grpc::ClientContext context;
    v1::CreateMapResponse response;
    return v1::MapService::NewStub(server_->Connect())->CreateMap(&context, request, &response);
  }
  static std::string NameOf(const v1::CreateMapRequest& request) { return "maps/" + request.map_id(); }
};

TEST_F(ClassNames, AreUniqueInAMapAndOfBoundedLengthAtBothDoors) {
  Start();
  v1::CreateMapRequest request = CreateRequest("room");
  ASSERT_EQ(request.label_classes(1).id(), 2u);
  request.mutable_label_classes(0)->set_name("cup");
  request.mutable_label_classes(1)->set_name("cup");
  ExpectRefused(request, "label_classes[2].name");
  request.mutable_label_classes(1)->set_name(std::string(129, 'x'));
  ExpectRefused(request, "label_classes[2].name");
  request.mutable_label_classes(1)->set_name(std::string(5'000'000, 'x'));
  ExpectRefused(request, "label_classes[2].name");

  request.mutable_label_classes(1)->set_name(std::string(128, 'x'));
  ExpectTaken(request);
  request.set_map_id("cases");
  request.mutable_label_classes(1)->set_name("Cup");
  ExpectTaken(request);
  request.set_map_id("unnamed");
  for (v1::LabelClass& label : *request.mutable_label_classes()) label.clear_name();
  ExpectTaken(request);
}

TEST_F(ClassNames, AreOfBoundedLengthAllTogether) {
  Start();
  v1::CreateMapRequest request = CreateRequest("room");
  request.clear_label_classes();
  constexpr std::uint32_t kNumClasses = (1u << 20) / 128 + 1;  // a MiB of names, and one
  for (std::uint32_t id = 0; id < kNumClasses; ++id) {
    v1::LabelClass* label = request.add_label_classes();
    label->set_id(id);
    label->set_kind(v1::LabelClass::THING);
    const std::string number = std::to_string(id);
    label->set_name(std::string(128 - number.size(), 'x') + number);
  }
  ExpectRefused(request, "label_classes");
}

// What every edit may say beside itself.

class EditsOverRest : public RestTest {};

TEST_F(EditsOverRest, AreTriedRepeatedAndConditionalInTheQueryOfAnEdit) {
  Start();
  Create("room");
  ASSERT_TRUE(Feed(*mapping_, "room", 0, 8).status.ok());
  v1::ListSubmapsResponse things;
  const http::HttpAnswer list = Ask("GET", "/v1/maps/room/submaps?kind=THING");
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(list.body, &things).ok()) << list.body;
  ASSERT_GE(things.submaps_size(), 1);
  const std::string name = "/v1/" + things.submaps(0).name();
  const std::string known = std::to_string(things.revision());
  const std::string id = "00000000-0000-4000-8000-000000000001";

  const http::HttpAnswer tried = Ask("PATCH", name + "?validate_only=true&author=anna", R"({"display_name":"mug"})");
  EXPECT_EQ(tried.status, 200) << tried.body;
  EXPECT_TRUE(ContainsText(tried.body, "mug")) << tried.body;
  EXPECT_NE(Get<v1::GetSubmapResponse>(things.submaps(0).name()).submap().display_name(), "mug");
  const std::string patch = name + "?author=anna&request_id=" + id + "&expected_revision=" + known;
  const http::HttpAnswer made = Ask("PATCH", patch, R"({"display_name":"mug"})");
  EXPECT_EQ(made.status, 200) << made.body;
  EXPECT_EQ(Ask("PATCH", patch, R"({"display_name":"mug"})").body, made.body);
  const http::HttpAnswer late = Ask("DELETE", name + "?expected_revision=" + known);
  EXPECT_EQ(late.status, 409) << late.body;
  EXPECT_TRUE(ContainsText(late.body, "EDITED_SINCE")) << late.body;
  EXPECT_EQ(Ask("DELETE", name + "?validate_only=true").status, 200);
  EXPECT_EQ(Ask("GET", name).status, 200) << "it was only tried";

  const http::HttpAnswer renamed = Ask("PATCH", "/v1/maps/room?validate_only=true", R"({"display_name":"home"})");
  EXPECT_EQ(renamed.status, 200) << renamed.body;
  EXPECT_TRUE(ContainsText(renamed.body, "home")) << renamed.body;
  EXPECT_NE(Get<v1::GetMapResponse>("maps/room").map().display_name(), "home");
  const std::string undo = "/v1/maps/room:undoEdits";
  EXPECT_EQ(Ask("POST", undo, R"({"author":"anna"})", {{"If-Match", "\"r1\""}}).status, 409) << "not the map's";
  EXPECT_EQ(Ask("POST", undo, R"({"author":"anna","expected_revision":)" + known + "}").status, 409);
  EXPECT_EQ(Ask("POST", undo, R"({"author":"anna","validate_only":true})").status, 200);
  EXPECT_EQ(Get<v1::GetSubmapResponse>(things.submaps(0).name()).submap().display_name(), "mug");
}

// If-Match.

class IfMatch : public RestTest {
 protected:
  void SetUp() override {
    Start();
    Create("room");
    ASSERT_TRUE(Feed(*mapping_, "room", 0, 8).status.ok());
    const http::HttpAnswer list = Ask("GET", "/v1/maps/room/submaps?kind=THING");
    v1::ListSubmapsResponse things;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(list.body, &things).ok()) << list.body;
    ASSERT_GE(things.submaps_size(), 2);
    first_ = things.submaps(0).name();
    second_ = things.submaps(1).name();
  }
  v1::Submap Now(const std::string& name) const { return Get<v1::GetSubmapResponse>(name).submap(); }
  http::HttpAnswer Rename(const std::string& name, const std::string& title, const std::string& if_match) const {
    return Ask("PATCH", "/v1/" + name, R"({"display_name":")" + title + "\"}", {{"If-Match", if_match}});
  }
  http::HttpAnswer Delete(const std::string& name, const std::string& if_match) const {
    return Ask("DELETE", "/v1/" + name, "", {{"If-Match", if_match}});
  }
  static std::string Quoted(const std::string& etag) { return '"' + etag + '"'; }
  /// Values of the header that are no entity tag which a server can compare, though the present one is in them.
  static std::vector<std::string> MalformedOf(const std::string& etag) {
    return {etag, "W/" + Quoted(etag), Quoted(etag) + ", " + Quoted("r1"), '"' + etag, "\""};
  }
  static void ExpectMismatch(const http::HttpAnswer& answer) {
    EXPECT_EQ(answer.status, 409) << answer.body;
    EXPECT_TRUE(ContainsText(answer.body, "ETAG_MISMATCH")) << answer.body;
  }

  std::string first_, second_;
};

TEST_F(IfMatch, DecidesWhetherAnObjectIsChanged) {
  const std::string before = Now(first_).etag();
  const http::HttpAnswer renamed = Rename(first_, "mug", Quoted(before));
  EXPECT_EQ(renamed.status, 200) << renamed.body;
  const v1::Submap mug = Now(first_);
  EXPECT_EQ(mug.display_name(), "mug");
  EXPECT_NE(mug.etag(), before);
  EXPECT_TRUE(ContainsText(renamed.body, mug.etag())) << "the answer has the new one: " << renamed.body;

  ExpectMismatch(Rename(first_, "stale", Quoted(before)));
  ExpectMismatch(Rename(first_, "of another", Quoted("0123456789abcdef-r1")));
  for (const std::string& bad : MalformedOf(mug.etag())) {
    const http::HttpAnswer refused = Rename(first_, "malformed", bad);
    EXPECT_EQ(refused.status, 400) << bad << ": " << refused.body;
    EXPECT_TRUE(ContainsText(refused.body, "BAD_HEADER")) << refused.body;
  }
  EXPECT_EQ(Now(first_).SerializeAsString(), mug.SerializeAsString()) << "what is refused changes nothing";

  EXPECT_EQ(Rename(first_, "cup", "*").status, 200) << "whatever it is now";
  EXPECT_EQ(Now(first_).display_name(), "cup");
}

TEST_F(IfMatch, DecidesWhetherAnObjectIsDeleted) {
  const std::string before = Now(first_).etag();
  ASSERT_EQ(Rename(first_, "mug", "*").status, 200);
  const std::string present = Now(first_).etag();
  ExpectMismatch(Delete(first_, Quoted(before)));
  for (const std::string& bad : MalformedOf(present)) EXPECT_EQ(Delete(first_, bad).status, 400) << bad;
  EXPECT_EQ(Now(first_).display_name(), "mug") << "it is still there";
  const http::HttpAnswer deleted = Delete(first_, Quoted(present));
  EXPECT_EQ(deleted.status, 200) << deleted.body;
  EXPECT_EQ(Ask("GET", "/v1/" + first_).status, 404);

  EXPECT_EQ(Delete(second_, "*").status, 200);
  EXPECT_EQ(Ask("GET", "/v1/" + second_).status, 404);
  EXPECT_EQ(Delete(second_, "*").status, 404);
}

// Feeders.

/// A client that has sent one frame and a half, and says no more while it stays connected.
class FrozenRestFeeder {
 public:
  FrozenRestFeeder(int http_port, const std::string& map_id) : client_(http_port) {
    client_.SendRaw("POST /v1/maps/" + map_id +
                    ":integrateFrames HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n"
                    "Content-Type: application/x-ndjson\r\n\r\n");
    v1::IntegrateFramesRequest request;
    *request.mutable_frame() = TestFrame(0);
    const std::string line = JsonOf(request) + "\n";
    SendChunk(line);
    is_feeding_ = Hears(R"("outcome":"FUSED")");
    SendChunk(line.substr(0, line.size() / 2));
  }
  [[nodiscard]] bool is_feeding() const { return is_feeding_; }
  /// Reads on until it is told this; false if the answer ends before.
  bool Hears(const std::string& part) {
    while (!ContainsText(heard_, part)) {
      const std::string more = client_.ReadSome();
      if (more.empty()) return false;
      heard_ += more;
    }
    return true;
  }
  [[nodiscard]] const std::string& heard() const { return heard_; }

 private:
  void SendChunk(const std::string& data) {
    std::ostringstream size;
    size << std::hex << data.size();
    client_.SendRaw(size.str() + "\r\n" + data + "\r\n");
  }

  http::HttpClient client_;
  std::string heard_;
  bool is_feeding_ = false;
};

class RestFeeders : public RestTest {
 protected:
  void StartWithIdleLimit(const std::string& feed_idle_s) {
    Start({{"DHPMAP_MAPPING_FEED_IDLE_S", feed_idle_s}});
    Create("room");
  }
  http::HttpAnswer DeleteRoom() const { return Ask("DELETE", "/v1/maps/room"); }
};

TEST_F(RestFeeders, AnImplausibleFrameIsToldOrRefusedAsItsSenderLikes) {
  Start({});
  Create("room");
  v1::IntegrateFramesRequest request;
  const auto post = [&](int sequence) {
    request.set_session("robot");
    request.set_sequence(sequence);
    *request.mutable_frame() = TestFrame(sequence);
    for (const int translation : {3, 7, 11}) {
      const double value_m = request.frame().map_from_sensor_matrix(translation);
      request.mutable_frame()->set_map_from_sensor_matrix(translation, 1000 * value_m);
    }
    return Ask("POST", "/v1/maps/room:integrateFrames", JsonOf(request), {{"Content-Type", "application/json"}});
  };
  EXPECT_EQ(post(0).status, 200);
  const http::HttpAnswer told = post(1);
  EXPECT_EQ(told.status, 200) << told.body;
  EXPECT_TRUE(ContainsText(told.body, R"("fault":"TRANSLATION_IN_MILLIMETRES")")) << told.body;
  request.set_refuse_implausible(true);
  const http::HttpAnswer refused = post(2);
  EXPECT_EQ(refused.status, 400) << refused.body;
  EXPECT_TRUE(ContainsText(refused.body, "IMPLAUSIBLE_FRAME")) << refused.body;
  EXPECT_TRUE(ContainsText(refused.body, R"("fault":"TRANSLATION_IN_MILLIMETRES")")) << refused.body;
  EXPECT_EQ(Get<v1::GetMapResponse>("maps/room").map().num_frames(), 2);
}

TEST_F(RestFeeders, OneThatIsFrozenLosesItsMapToWhoTakesOver) {
  StartWithIdleLimit("86400");
  FrozenRestFeeder frozen(http_port(), "room");
  ASSERT_TRUE(frozen.is_feeding()) << frozen.heard();
  const grpc::Status polite = Feed(*mapping_, "room", 1, 2).status;
  EXPECT_EQ(polite.error_code(), grpc::ABORTED);
  EXPECT_EQ(ReasonOf(polite), "MAP_IS_FED");
  const http::HttpAnswer kept = DeleteRoom();
  EXPECT_EQ(kept.status, 400) << kept.body;
  EXPECT_TRUE(ContainsText(kept.body, "MAP_IS_FED")) << kept.body;

  Feeder other(*mapping_, "room", {.take_over = true});
  const auto fused = other.Feed(1);
  ASSERT_TRUE(fused);
  EXPECT_EQ(fused->outcome(), v1::IntegrateFramesResponse::FUSED);
  EXPECT_TRUE(frozen.Hears("FEED_TAKEN_OVER")) << frozen.heard();
  other.HalfClose();
  EXPECT_TRUE(other.Finish().ok());
  const http::HttpAnswer deleted = DeleteRoom();
  EXPECT_EQ(deleted.status, 200) << deleted.body;
}

TEST_F(RestFeeders, OneThatIsFrozenMakesPlaceForAnotherOnceItHasBeenIdle) {
  StartWithIdleLimit("0.2");
  FrozenRestFeeder frozen(http_port(), "room");
  ASSERT_TRUE(frozen.is_feeding()) << frozen.heard();
  EXPECT_TRUE(Eventually([&] { return Feed(*mapping_, "room", 1, 2).status.ok(); }));
  EXPECT_TRUE(frozen.Hears("FEED_IDLE")) << frozen.heard();
  EXPECT_EQ(Get<v1::GetMapResponse>("maps/room").map().num_frames(), 2) << "its half frame is none";
}

TEST_F(RestFeeders, OneThatIsFrozenDoesNotKeepItsMapFromBeingDeleted) {
  StartWithIdleLimit("0.2");
  FrozenRestFeeder frozen(http_port(), "room");
  ASSERT_TRUE(frozen.is_feeding()) << frozen.heard();
  EXPECT_TRUE(Eventually([&] { return DeleteRoom().status == 200; }));
  EXPECT_TRUE(frozen.Hears("FEED_IDLE")) << frozen.heard();
  EXPECT_EQ(Ask("GET", "/v1/maps/room").status, 404);
}

TEST_F(RestFeeders, OneBeyondTheLimitIsRefusedAtOnceAndTheOthersGoOn) {
  Start({{"DHPMAP_MAPPING_MAX_FEEDS", "2"}});
  Create("room");
  Feeder a(*mapping_, "room", {.session = "a"}), b(*mapping_, "room", {.session = "b"});
  ASSERT_TRUE(a.Feed(0) && b.Feed(1));
  const http::HttpAnswer refused = PostFrame("room", "c", 2);
  EXPECT_EQ(refused.status, 429) << refused.body;
  EXPECT_TRUE(ContainsText(refused.body, "TOO_MANY_FEEDS")) << refused.body;
  for (Feeder* feeder : {&a, &b}) {
    const auto fused = feeder->Feed(3);
    ASSERT_TRUE(fused);
    EXPECT_EQ(fused->outcome(), v1::IntegrateFramesResponse::FUSED);
  }
  a.HalfClose();
  ASSERT_TRUE(a.Finish().ok());
  const http::HttpAnswer taken = PostFrame("room", "c", 2);
  EXPECT_EQ(taken.status, 200) << taken.body;
}

}  // namespace
}  // namespace dhpmap::testing
