// SPDX-License-Identifier: BSD-3-Clause
// Reflection as a client uses it: one stream of questions, answered one by one.
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <set>
#include <string>

#include "grpc/reflection/v1/reflection.grpc.pb.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

using grpc::reflection::v1::ServerReflection;
using grpc::reflection::v1::ServerReflectionRequest;
using grpc::reflection::v1::ServerReflectionResponse;

class Reflection : public ::testing::Test {
 protected:
  Reflection() { context_.set_deadline(std::chrono::system_clock::now() + kPatience); }

  /// False if the stream has ended.
  bool Ask(const ServerReflectionRequest& request) { return stream_->Write(request) && stream_->Read(&answer_); }
  bool AskForSymbol(const std::string& symbol) {
    ServerReflectionRequest request;
    request.set_file_containing_symbol(symbol);
    return Ask(request);
  }
  bool AskForServices() {
    ServerReflectionRequest request;
    request.set_list_services("*");
    return Ask(request);
  }

  const std::shared_ptr<ByteBudget> budget_ = std::make_shared<ByteBudget>(64u << 20, 16u << 10);
  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  TestServer server_{*store_, {}, {.inflight = budget_}};
  grpc::ClientContext context_;
  std::unique_ptr<ServerReflection::Stub> stub_ = ServerReflection::NewStub(server_.channel());
  std::unique_ptr<grpc::ClientReaderWriter<ServerReflectionRequest, ServerReflectionResponse>> stream_ =
      stub_->ServerReflectionInfo(&context_);
  ServerReflectionResponse answer_;
};

TEST_F(Reflection, DescribesEachServiceThatItLists) {
  ASSERT_TRUE(AskForServices());
  std::set<std::string> listed;
  for (const auto& service : answer_.list_services_response().service()) listed.insert(service.name());
  EXPECT_EQ(listed,
            (std::set<std::string>{"dhpmap.v1.EditService", "dhpmap.v1.MapService", "dhpmap.v1.MappingService",
                                   "dhpmap.v1.AuthService", "dhpmap.v1.FleetService", "dhpmap.v1.ServerService",
                                   "dhpmap.v1.QueryService", "dhpmap.v1.SubmapService", "dhpmap.v1.WatchService",
                                   "grpc.health.v1.Health", "grpc.reflection.v1.ServerReflection",
                                   "grpc.reflection.v1alpha.ServerReflection"}));
  for (const std::string& name : listed) {
    ASSERT_TRUE(AskForSymbol(name));
    ASSERT_GT(answer_.file_descriptor_response().file_descriptor_proto_size(), 0) << name;
    google::protobuf::FileDescriptorProto file;
    ASSERT_TRUE(file.ParseFromString(answer_.file_descriptor_response().file_descriptor_proto(0)));
    ASSERT_EQ(file.service_size(), 1) << name;
    EXPECT_EQ(file.package() + "." + file.service(0).name(), name);
  }
  stream_->WritesDone();
  EXPECT_OK(stream_->Finish());
}

TEST_F(Reflection, ContinuesAfterAnUnknownName) {
  ASSERT_TRUE(AskForSymbol("no.Service"));
  EXPECT_EQ(answer_.error_response().error_code(), grpc::NOT_FOUND);
  EXPECT_EQ(answer_.original_request().file_containing_symbol(), "no.Service");
  ASSERT_TRUE(AskForSymbol("dhpmap.v1.MapService"));
  EXPECT_TRUE(answer_.has_file_descriptor_response());
}

TEST_F(Reflection, HoldsNothingBetweenQuestions) {
  ASSERT_TRUE(AskForSymbol(std::string(60'000, 'x')));
  EXPECT_EQ(answer_.error_response().error_code(), grpc::NOT_FOUND);
  ASSERT_TRUE(AskForSymbol("dhpmap.v1.MapService"));
  EXPECT_TRUE(Eventually([&] { return budget_->used_bytes() == 0; })) << budget_->used_bytes();
}

TEST_F(Reflection, StaysWithinTheBudget) {
  ASSERT_TRUE(budget_->TryTake(budget_->limit_bytes()));
  ASSERT_TRUE(AskForServices());  // small
  EXPECT_TRUE(answer_.has_list_services_response());
  ASSERT_FALSE(AskForSymbol("dhpmap.v1.MapService"));
  const grpc::Status status = stream_->Finish();
  EXPECT_EQ(status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(ReasonOf(status), "TOO_MANY_BYTES");
  budget_->GiveBack(budget_->limit_bytes());
}

TEST_F(Reflection, EndsWithTheServer) {
  ASSERT_TRUE(AskForServices());
  server_.grpc().Drain();
  EXPECT_FALSE(stream_->Read(&answer_));
  const grpc::Status status = stream_->Finish();
  EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE);
  EXPECT_EQ(ReasonOf(status), "SHUTTING_DOWN");
}

}  // namespace
}  // namespace dhpmap::testing
