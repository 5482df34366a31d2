// SPDX-License-Identifier: BSD-3-Clause
// Requests that grow many times when parsed, and malformed requests, for all methods.
#include <google/protobuf/descriptor.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

constexpr std::size_t kLarge_bytes = 8u << 20, kHuge_bytes = 32u << 20;
/// More memory than client and server need for the bytes; the parsed message takes 1 to 3 GiB.
#if defined(DHPMAP_SANITIZED)
constexpr long kMostGrowth_KiB = 3 * (700 << 10);  // sanitizers' shadow memory takes several times that
#else
constexpr long kMostGrowth_KiB = 700 << 10;
#endif

std::string Many(const std::string& what, std::size_t num_bytes) {
  std::string all;
  all.reserve(num_bytes);
  while (all.size() + what.size() <= num_bytes) all += what;
  return all;
}
const std::string kUnknownNumber("\x78\x00", 2), kUnknownText("\x7a\x00", 2), kUnknownGroup("\x7b\x7c", 2);

/// `text` as a field of a message; `number` up to 15.
std::string InField(int number, const std::string& text) {
  std::string field(1, static_cast<char>(number << 3 | 2));
  for (std::size_t length = text.size(); true; length >>= 7) {
    const bool is_last = length < 0x80;
    field += static_cast<char>((length & 0x7f) | (is_last ? 0 : 0x80));
    if (is_last) return field + text;
  }
}

long Peak_KiB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

std::vector<const google::protobuf::MethodDescriptor*> AllMethods() {
  std::vector<const google::protobuf::MethodDescriptor*> methods;
  for (const char* name :
       {"MapService", "MappingService", "SubmapService", "EditService", "QueryService", "WatchService"}) {
    const auto* service =
        google::protobuf::DescriptorPool::generated_pool()->FindServiceByName(std::string("dhpmap.v1.") + name);
    for (int i = 0; i < service->method_count(); ++i) methods.push_back(service->method(i));
  }
  return methods;
}

/// The answer to raw bytes, for any kind of method.
struct RawAnswer {
  grpc::Status status;
  std::vector<grpc::ByteBuffer> messages;
};

class LargeRequests : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(server_.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(server_, "room", 0, 2));
  }

  RawAnswer Send(const std::string& path, const std::vector<std::string>& messages) {
    grpc::CompletionQueue queue;
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kPatience);
    grpc::GenericStub stub(server_.channel());
    const auto call = stub.PrepareCall(&context, path, &queue);
    const auto wait = [&queue] {
      void* tag = nullptr;
      bool is_well = false;
      return queue.Next(&tag, &is_well) && is_well;
    };
    call->StartCall(nullptr);
    bool goes_on = wait();
    for (std::size_t i = 0; goes_on && i < messages.size(); ++i) {
      const grpc::Slice slice(messages[i].data(), messages[i].size(), grpc::Slice::STATIC_SLICE);
      call->Write(grpc::ByteBuffer(&slice, 1), nullptr);
      goes_on = wait();
    }
    if (goes_on) call->WritesDone(nullptr), (void)wait();
    RawAnswer answer;
    for (grpc::ByteBuffer message; call->Read(&message, nullptr), wait();) answer.messages.push_back(message);
    call->Finish(&answer.status, nullptr);
    (void)wait();
    queue.Shutdown();
    while (wait()) {
    }
    return answer;
  }
  RawAnswer Send(const google::protobuf::MethodDescriptor& method, const std::string& message) {
    return Send("/" + method.service()->full_name() + "/" + method.name(), {message});
  }

  void ExpectAllIsWell() {
    EXPECT_TRUE(Eventually([&] { return budget_->used_bytes() == 0; })) << budget_->used_bytes();
    EXPECT_OK(server_.Call(&QueryStub::QueryPoints, TestQuery("room")));
  }

  const std::shared_ptr<ByteBudget> budget_ = std::make_shared<ByteBudget>(192u << 20, 16u << 10);
  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  TestServer server_{*store_, {}, {.inflight = budget_}};
};

TEST_F(LargeRequests, OfTinyFieldsAreRefusedBeforeParsing) {
  const long before_KiB = Peak_KiB();
  const auto expect_refused = [&](const std::string& method, const std::string& message) {
    const grpc::Status status = Send("/dhpmap.v1." + method, {message}).status;
    EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << method << ": " << status.error_message();
    EXPECT_EQ(ReasonOf(status), "BODY_TOO_LARGE") << method;
  };
  for (const std::string& what : {kUnknownNumber, kUnknownText, kUnknownGroup}) {
    expect_refused("QueryService/QueryPoints", Many(what, kLarge_bytes));
  }
  expect_refused("MapService/ImportMap", Many(kUnknownText, kLarge_bytes));
  expect_refused("QueryService/CastRays", InField(5, Many(kUnknownText, kLarge_bytes)));         // options
  expect_refused("QueryService/QueryDistances", Many(std::string("\x1a\x00", 2), kHuge_bytes));  // points
  expect_refused("EditService/ApplyEdits", Many(std::string("\x12\x00", 2), kLarge_bytes));      // edits
  // Watches stay open: a few such requests would use up the whole budget.
  expect_refused("WatchService/WatchMap", Many(kUnknownNumber, (1u << 20) - 64));
  EXPECT_LT(Peak_KiB() - before_KiB, kMostGrowth_KiB);
  ExpectAllIsWell();
}

TEST_F(LargeRequests, InAStreamOfQueriesAreRefusedAndTheStreamContinues) {
  const long before_KiB = Peak_KiB();
  v1::StreamQueriesRequest number, query;
  number.set_sequence(7);
  query.set_sequence(8);
  *query.mutable_query_points() = TestQuery("room");
  const std::string bomb = number.SerializeAsString() + Many(kUnknownText, kHuge_bytes);
  const std::string points = InField(3, Many(std::string("\x1a\x00", 2), kHuge_bytes)) + number.SerializeAsString();
  const RawAnswer answer = Send("/dhpmap.v1.QueryService/StreamQueries",
                                {bomb, query.SerializeAsString(), points, query.SerializeAsString()});
  EXPECT_OK(answer.status);
  ASSERT_EQ(answer.messages.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    v1::StreamQueriesResponse message;
    grpc::ByteBuffer bytes = answer.messages[i];
    ASSERT_OK(grpc::SerializationTraits<v1::StreamQueriesResponse>::Deserialize(&bytes, &message));
    const bool is_refused = i % 2 == 0;
    EXPECT_EQ(message.sequence(), is_refused ? 7 : 8);
    EXPECT_EQ(message.error().code(), is_refused ? static_cast<int>(grpc::StatusCode::RESOURCE_EXHAUSTED) : 0);
    EXPECT_EQ(message.has_query_points(), !is_refused);
  }
  EXPECT_LT(Peak_KiB() - before_KiB, kMostGrowth_KiB);
  ExpectAllIsWell();
}

TEST_F(LargeRequests, ToReflectionAreRefusedAndOthersAnswered) {
  const long before_KiB = Peak_KiB();
  const std::string list("\x3a\x01*", 3);
  for (const char* version : {"v1", "v1alpha"}) {
    const std::string method = std::string("/grpc.reflection.") + version + ".ServerReflection/ServerReflectionInfo";
    for (const std::string& bomb : {Many(kUnknownText, 4u << 20), InField(4, std::string(64u << 10, 'x'))}) {
      const RawAnswer answer = Send(method, {list, bomb});
      EXPECT_EQ(answer.messages.size(), 1u) << bomb.size();
      EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << bomb.size();
      EXPECT_EQ(ReasonOf(answer.status), "BODY_TOO_LARGE") << bomb.size();
    }
    const RawAnswer malformed = Send(method, {std::string("\x3a\x05y", 3)});
    EXPECT_EQ(malformed.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_EQ(ReasonOf(malformed.status), "MALFORMED_PROTOBUF");
    const RawAnswer small = Send(method, {list + Many(kUnknownText, 60u << 10), list});
    EXPECT_OK(small.status);
    EXPECT_EQ(small.messages.size(), 2u);
  }
  const std::string huge = Many(kUnknownText, kHuge_bytes);
  EXPECT_EQ(ReasonOf(Send("/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", {huge}).status),
            "BODY_TOO_LARGE");
  EXPECT_LT(Peak_KiB() - before_KiB, kMostGrowth_KiB);
  ExpectAllIsWell();
}

TEST_F(LargeRequests, ThatAreMalformedAreRefusedByEveryMethodWithAReason) {
  for (const auto* method : AllMethods()) {
    for (const std::string& bytes : {std::string("\xff\xff\xff", 3), std::string("\x0a\x05y", 3)}) {
      const grpc::Status status = Send(*method, bytes).status;
      EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << method->full_name();
      EXPECT_EQ(ReasonOf(status), "MALFORMED_PROTOBUF") << method->full_name();
    }
  }
  ExpectAllIsWell();
}

TEST_F(LargeRequests, AreReadOnlyByMethodsWhoseRequestsHaveLists) {
  const std::string text(2u << 20, 'x');
  int num_large = 0;
  for (const auto* method : AllMethods()) {
    if (method->client_streaming()) continue;
    // A method that reads the request refuses it for lack of a known field.
    const grpc::Status status = Send(*method, InField(15, text)).status;
    if (ReasonOf(status) != "BODY_TOO_LARGE") ++num_large;
  }
  EXPECT_EQ(num_large, 8);
  ExpectAllIsWell();
}

TEST_F(LargeRequests, OfNewerClientsAreAccepted) {
  v1::GetMapRequest request;
  request.set_name("maps/room");
  const RawAnswer answer =
      Send("/dhpmap.v1.MapService/GetMap", {request.SerializeAsString() + Many(kUnknownNumber, 64)});
  EXPECT_OK(answer.status);
  EXPECT_EQ(answer.messages.size(), 1u);
}

}  // namespace
}  // namespace dhpmap::testing
