// SPDX-License-Identifier: BSD-3-Clause
// A file as body, for an RPC that takes it in parts.
#include <algorithm>
#include <string>

#include "dhpmap/v1/map_service.pb.h"
#include "tests/unit/server/gateway/gateway_fixture.h"

namespace dhpmap::gateway {
namespace {

/// What the RPC has received of a file.
struct HeardFile {
  std::string bytes;
  std::size_t largest_part = 0;
  v1::ImportMapRequest first;
};
HeardFile FileIn(const HeardCall& call) {
  HeardFile file;
  for (const std::string& bytes : call.requests) {
    v1::ImportMapRequest part;
    EXPECT_TRUE(part.ParseFromString(bytes));
    if (file.bytes.empty()) file.first = part;
    file.largest_part = std::max(file.largest_part, part.data().size());
    file.bytes += part.data();
  }
  return file;
}

CannedAnswer Imported() {
  v1::ImportMapResponse response;
  response.set_revision(7);
  return {.messages = {response.SerializeAsString()}, .at_end = true};
}

std::string AnyBytes(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * 7 + i / 251);
  return bytes;
}

/// More than one part takes. Under ThreadSanitizer a megabyte takes the client's patience: see DHPMAP_SKIP_MEGABYTES.
#ifdef DHPMAP_THREAD_SANITIZER
constexpr int kSomeParts_bytes = 300'000;
#else
constexpr int kSomeParts_bytes = 900'000;
#endif

TEST_F(GatewayTest, AFileIsPassedToTheRpcInPartsUnchanged) {
  server.Set("ImportMap", Imported());
  const std::string bytes = AnyBytes(kSomeParts_bytes);
  std::size_t number = 0;
  for (const char* type :
       {"application/octet-stream", "application/vnd.sqlite3", "application/x-www-form-urlencoded"}) {
    SCOPED_TRACE(type);
    const http::HttpAnswer answer =
        client->Ask("POST", "/v1/maps:import?mapId=office", bytes, {{"Content-Type", type}});
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(At(AsJson(answer.body), "revision").string_value(), "7");
    const HeardFile file = FileIn(server.WaitForCall(++number));
    EXPECT_TRUE(file.bytes == bytes);
    EXPECT_LE(file.largest_part, 256u << 10);
    EXPECT_EQ(file.first.map_id(), "office");
    EXPECT_EQ(file.first.total_bytes(), kSomeParts_bytes) << "from the head";
  }
}

TEST_F(GatewayTest, AFileMayBeLargerThanAnyMessageOfUnknownSizeOrEmpty) {
  DHPMAP_SKIP_MEGABYTES();
  server.Set("ImportMap", Imported());
  const std::string bytes = AnyBytes(3 * kMaxBody_bytes);
  EXPECT_EQ(client->Ask("POST", "/v1/maps:import", bytes).status, 200);
  EXPECT_TRUE(FileIn(server.WaitForCall(1)).bytes == bytes);

  ASSERT_TRUE(
      client->SendRaw("POST /v1/maps:import?map_id=a HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
                      "3\r\nabc\r\n4\r\ndefg\r\n0\r\n\r\n"));
  EXPECT_EQ(client->ReadAnswer().status, 200);
  const HeardFile chunked = FileIn(server.WaitForCall(2));
  EXPECT_EQ(chunked.bytes, "abcdefg");
  EXPECT_EQ(chunked.first.total_bytes(), 0);

  EXPECT_EQ(client->Ask("POST", "/v1/maps:import?map_id=a", "").status, 200);
  const HeardCall empty = server.WaitForCall(3);
  ASSERT_EQ(empty.requests.size(), 1u) << "what the URL says is said all the same";
  EXPECT_EQ(FileIn(empty).first.map_id(), "a");
}

TEST_F(GatewayTest, AFormIsNotAFile) {
  const http::HttpAnswer answer =
      client->Ask("POST", "/v1/maps:import", "--x\r\n", {{"Content-Type", "multipart/form-data; boundary=x"}});
  EXPECT_EQ(answer.status, 415);
  EXPECT_NE(answer.body.find("octet-stream"), std::string::npos);
  EXPECT_EQ(
      client->Ask("POST", "/v1/maps/a:integrateFrames", "x", {{"Content-Type", "application/octet-stream"}}).status,
      415)
      << "nor are messages";
}

TEST_F(GatewayTest, AFileMayBeSentAsLinesOfJson) {
  server.Set("ImportMap", Imported());
  EXPECT_EQ(
      client->Ask("POST", "/v1/maps:import", "\"YWJj\"\n\"ZGVm\"\n", {{"Content-Type", "application/x-ndjson"}}).status,
      200);
  EXPECT_EQ(FileIn(server.WaitForCall()).bytes, "abcdef");
}

TEST_F(GatewayTest, ARefusalOfAFileIsSentBeforeTheWholeFileHasArrived) {
  server.Set("ImportMap", {.messages = {}, .status = grpc::Status(grpc::ALREADY_EXISTS, "there is one")});
  ASSERT_TRUE(client->SendRaw(
      "POST /v1/maps:import?map_id=a HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\nabc"));
  EXPECT_EQ(client->ReadAnswer().status, 409);
}

TEST_F(GatewayTest, AClientThatDisconnectsDuringAFileCancelsTheCall) {
  server.Set("ImportMap", {.hang = true});
  ASSERT_TRUE(client->SendRaw(
      "POST /v1/maps:import?map_id=a HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\nabc"));
  (void)server.WaitForCall();
  client.reset();
  EXPECT_TRUE(server.WaitForCancel());
}

}  // namespace
}  // namespace dhpmap::gateway
