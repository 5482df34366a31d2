// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/stream_encoder.h"

#include <algorithm>

#include "dhpmap/v1/submap_service.pb.h"
#include "dhpmap/v1/watch_service.pb.h"
#include "json_test.pb.h"
#include "server/gateway/shared_answers.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

std::string Part(const std::string& data, const std::string& type = "", std::int64_t total_bytes = 0) {
  json::test::Part part;
  part.set_data(data);
  part.set_content_type(type);
  part.set_total_bytes(total_bytes);
  return part.SerializeAsString();
}

const Route& Download() { return *Matched("GET", "/test/files/x").route; }
const Route& Voxels() { return *Matched("GET", "/v1/maps/a/submaps/1/voxels").route; }

TEST(StreamEncoder, OnlyTheFirstPartHasAHead) {
  for (const AnswerFormat format : {AnswerFormat::kAny, AnswerFormat::kJson, AnswerFormat::kProtobuf}) {
    StreamEncoder encoder(Download(), format, "x");
    EXPECT_TRUE(encoder.Encode(Part("a"))->head);
    EXPECT_FALSE(encoder.Encode(Part("b"))->head);
  }
}

TEST(StreamEncoder, JoinsTheDataOfAFile) {
  StreamEncoder encoder(Download(), AnswerFormat::kAny, "x");
  const auto first = encoder.Encode(Part("ab", "application/x-ply", 5));
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(first->data, "ab");
  EXPECT_EQ(first->head->length, 5u);
  EXPECT_EQ(http::FindHeader(first->head->headers, "content-type"), "application/x-ply");
  EXPECT_EQ(http::FindHeader(first->head->headers, "content-disposition"), "attachment; filename=\"x.ply\"");
  EXPECT_EQ(encoder.Encode(Part(""))->data, "") << "an empty part is none";
  EXPECT_EQ(encoder.Encode(Part("cde"))->data, "cde");
  EXPECT_FALSE(encoder.is_text()) << "an error in the middle of a file would be part of it";
}

TEST(StreamEncoder, AnRpcCannotInjectAHeader) {
  StreamEncoder encoder(Download(), AnswerFormat::kAny, "x");
  const auto first = encoder.Encode(Part("", "text/plain\r\nSet-Cookie: a=b", -7));
  ASSERT_TRUE(first.ok());
  for (const auto& [name, value] : first->head->headers) {
    EXPECT_EQ(value.find_first_of("\r\n"), std::string::npos) << name << ": " << value;
  }
  EXPECT_FALSE(first->head->length) << "a size that is none";
}

TEST(StreamEncoder, WritesOneLinePerMessage) {
  StreamEncoder encoder(Voxels(), AnswerFormat::kAny, "");
  v1::StreamSubmapVoxelsResponse message;
  message.set_revision(7);
  const auto part = encoder.Encode(message.SerializeAsString());
  ASSERT_TRUE(part.ok());
  EXPECT_TRUE(part->data.starts_with(R"({"result":{)")) << part->data;
  EXPECT_EQ(part->data.find('\n'), part->data.size() - 1);
  EXPECT_EQ(part->head->headers, encoder.EmptyHead());
  EXPECT_TRUE(encoder.is_text());
}

TEST(StreamEncoder, PrefixesProtobufMessagesWithTheirLength) {
  StreamEncoder encoder(Voxels(), AnswerFormat::kProtobuf, "");
  EXPECT_EQ(encoder.Encode("")->data, std::string(1, '\0'));
  EXPECT_EQ(encoder.Encode(std::string(300, 'x'))->data, "\xAC\x02" + std::string(300, 'x'));
  EXPECT_FALSE(encoder.is_text());
}

TEST(StreamEncoder, AMessageOfAnotherTypeIsInternal) {
  for (const AnswerFormat format : {AnswerFormat::kAny, AnswerFormat::kJson}) {
    StreamEncoder encoder(Download(), format, "x");
    EXPECT_EQ(encoder.Encode("\xFF").status().code(), StatusCode::kInternal);
  }
}

TEST(StreamEncoder, GivesFilesTheirExtension) {
  EXPECT_EQ(ExtensionOf("application/x-ply"), "ply");
  EXPECT_EQ(ExtensionOf("model/gltf-binary"), "glb");
  EXPECT_EQ(ExtensionOf("text/csv; charset=utf-8"), "csv");
  EXPECT_EQ(ExtensionOf("application/../x"), "bin");
  EXPECT_EQ(ExtensionOf(""), "bin");
}

const Route& Watch() { return *Matched("GET", "/v1/maps/a:watch").route; }

TEST(StreamEncoder, AnEventContainsItsPositionAndType) {
  StreamEncoder encoder(Watch(), AnswerFormat::kEvents, "");
  v1::WatchMapResponse message;
  message.set_position("abc-7");
  message.mutable_progress()->set_revision(7);
  const auto first = encoder.Encode(message.SerializeAsString());
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(http::FindHeader(first->head->headers, "content-type"), "text/event-stream");
  EXPECT_EQ(http::FindHeader(first->head->headers, "cache-control"), "no-store");
  EXPECT_TRUE(first->data.starts_with("event: progress\nid: abc-7\ndata: {")) << first->data;
  EXPECT_TRUE(first->data.ends_with("}\n\n")) << first->data;
  message.mutable_heartbeat();
  EXPECT_EQ(encoder.Encode(message.SerializeAsString())->data, ": heartbeat\n\n");
  message.mutable_change()->set_display_name("two\nlines");
  const std::string change = encoder.Encode(message.SerializeAsString())->data;
  EXPECT_EQ(std::count(change.begin(), change.end(), '\n'), 4) << change;
  EXPECT_TRUE(encoder.is_text());
  EXPECT_TRUE(encoder.ErrorText({14, "gone", ""}).starts_with("event: error\ndata: {\"code\":14,"));
  EXPECT_EQ(encoder.Silence(), ":\n\n");
}

TEST(StreamEncoder, ClientsOfTheSameEventShareItsEncoding) {
  SharedAnswers shared;
  StreamEncoder events(Watch(), AnswerFormat::kEvents, "", &shared), same(Watch(), AnswerFormat::kEvents, "", &shared),
      lines(Watch(), AnswerFormat::kJson, "", &shared), alone(Watch(), AnswerFormat::kEvents, "");
  v1::WatchMapResponse message;
  for (int revision = 1; revision < 4; ++revision) {
    message.set_position("abc-" + std::to_string(revision));
    message.mutable_progress()->set_revision(revision);
    const std::string bytes = message.SerializeAsString();
    const std::string expected = alone.Encode(bytes)->data;
    EXPECT_EQ(events.Encode(bytes)->data, expected);
    EXPECT_TRUE(lines.Encode(bytes)->data.starts_with(R"({"result":)"));
    EXPECT_EQ(same.Encode(bytes)->data, expected);
  }
  EXPECT_FALSE(events.Encode("garbage \xFF").ok());
  EXPECT_FALSE(same.Encode("garbage \xFF").ok());
}

TEST(StreamEncoder, EventsAreLinesUnlessRequested) {
  StreamEncoder encoder(Watch(), AnswerFormat::kAny, "");
  v1::WatchMapResponse message;
  message.set_position("abc-7");
  message.mutable_heartbeat();
  EXPECT_TRUE(encoder.Encode(message.SerializeAsString())->data.starts_with(R"({"result":{"position":"abc-7")"));
  EXPECT_EQ(encoder.Silence(), "\n");
}

TEST(StreamEncoder, AStreamWithoutPositionsSendsEventsWithoutOne) {
  StreamEncoder encoder(Voxels(), AnswerFormat::kEvents, "");
  EXPECT_TRUE(encoder.Encode(v1::StreamSubmapVoxelsResponse().SerializeAsString())->data.starts_with("data: {"));
  EXPECT_EQ(encoder.Silence(), "") << "it is never silent for long";
}

}  // namespace
}  // namespace dhpmap::gateway
