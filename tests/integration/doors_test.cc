// SPDX-License-Identifier: BSD-3-Clause
#include <google/protobuf/descriptor.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "google/rpc/error_details.pb.h"
#include "tests/integration/test_server.h"

namespace dhpmap::testing {
namespace {

/// Calls any method with raw bytes and one request, and returns its status.
grpc::Status CallRaw(const std::shared_ptr<grpc::Channel>& channel, const std::string& method, const std::string& bytes,
                     std::string* answers = nullptr) {
  grpc::ClientContext context;
  grpc::CompletionQueue queue;
  grpc::GenericStub stub(channel);
  const auto stream = stub.PrepareCall(&context, method, &queue);
  const auto wait = [&queue] {
    void* tag = nullptr;
    bool ok = false;
    return queue.Next(&tag, &ok) && ok;
  };
  stream->StartCall(nullptr);
  wait();
  const grpc::Slice slice(bytes);
  stream->WriteLast(grpc::ByteBuffer(&slice, 1), grpc::WriteOptions(), nullptr);
  wait();
  grpc::ByteBuffer answer;
  for (stream->Read(&answer, nullptr); wait(); stream->Read(&answer, nullptr)) {
    grpc::Slice whole;
    if (answers != nullptr && answer.DumpToSingleSlice(&whole).ok()) {
      answers->append(reinterpret_cast<const char*>(whole.begin()), whole.size());
    }
  }
  grpc::Status status;
  stream->Finish(&status, nullptr);
  wait();
  return status;
}

std::vector<const google::protobuf::MethodDescriptor*> OurMethods() {
  std::vector<const google::protobuf::MethodDescriptor*> methods;
  for (const char* file : {"map", "mapping", "submap", "query", "watch"}) {
    const auto* descriptor = google::protobuf::DescriptorPool::generated_pool()->FindFileByName(
        std::string("dhpmap/v1/") + file + "_service.proto");
    for (int s = 0; descriptor != nullptr && s < descriptor->service_count(); ++s) {
      for (int m = 0; m < descriptor->service(s)->method_count(); ++m) {
        methods.push_back(descriptor->service(s)->method(m));
      }
    }
  }
  return methods;
}

TEST(Doors, EveryRpcInTheDescriptorsIsImplemented) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  (void)v1::CreateMapRequest::descriptor();  // links the descriptors
  const auto methods = OurMethods();
  ASSERT_GE(methods.size(), 15u);
  for (const auto& channel : {server.channel(), server.grpc().InProcessChannel()}) {
    for (const auto* method : methods) {
      const std::string path = "/" + method->service()->full_name() + "/" + method->name();
      const grpc::Status status = CallRaw(channel, path, "");
      EXPECT_NE(status.error_code(), grpc::UNIMPLEMENTED) << path;
      // An empty request is invalid, except where no field is required.
      const bool needs_nothing =
          method->name() == "ListMaps" || method->name() == "StreamQueries";  // reports the error in its answer
      const bool needs_a_file = method->name() == "BackupMaps" || method->name() == "ImportMap";
      EXPECT_EQ(status.error_code(), needs_nothing  ? grpc::OK
                                     : needs_a_file ? grpc::FAILED_PRECONDITION
                                                    : grpc::INVALID_ARGUMENT)
          << path;
    }
    EXPECT_EQ(CallRaw(channel, "/dhpmap.v1.MapService/NoSuchMethod", "").error_code(), grpc::UNIMPLEMENTED);
  }
}

TEST(Doors, ReflectionListsAndDescribesEveryService) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  const auto ask = [&server](char tag, const std::string& what) {
    std::string answer;
    const std::string request = std::string({tag, static_cast<char>(what.size())}) + what;
    const char* const method = "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo";
    EXPECT_OK(CallRaw(server.channel(), method, request, &answer));
    return answer;
  };
  constexpr char kListServices = '\x3a', kFileContainingSymbol = '\x22';  // ServerReflectionRequest's fields 7 and 4
  const std::string services = ask(kListServices, "*");
  const std::pair<const char*, const char*> described[] = {{"dhpmap.v1.MapService", "CreateMapRequest"},
                                                           {"dhpmap.v1.QueryService", "QueryPointsRequest"},
                                                           {"grpc.health.v1.Health", "HealthCheckRequest"}};
  for (const auto& [service, message] : described) {
    EXPECT_NE(services.find(service), std::string::npos) << service;
    EXPECT_NE(ask(kFileContainingSymbol, service).find(message), std::string::npos) << service;
  }
}

TEST(Doors, HealthFollowsTheServer) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  const std::string service = "dhpmap.v1.MapService";
  const std::string request = std::string("\x0a") + static_cast<char>(service.size()) + service;
  EXPECT_OK(CallRaw(server.channel(), "/grpc.health.v1.Health/Check", request));
  EXPECT_EQ(CallRaw(server.channel(), "/grpc.health.v1.Health/Check", "\x0a\x01x").error_code(), grpc::NOT_FOUND);
  EXPECT_TRUE(server.grpc().is_serving());
  server.grpc().SetServing(false);
  EXPECT_FALSE(server.grpc().is_serving());
}

TEST(Doors, CreateMapNamesEveryBadFieldAtOnce) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  v1::CreateMapRequest request = CreateRequest("No Such Name");
  request.set_preset("underwater");
  request.mutable_config()->set_voxel_size_m(-0.1);
  request.mutable_config()->mutable_tracking()->set_iou_threshold(7);
  request.mutable_label_classes(1)->set_kind(v1::LabelClass::PANOPTIC_KIND_UNSPECIFIED);
  const grpc::Status status = server.Call(&MapStub::CreateMap, request).status();
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  const auto bad = DetailOf<google::rpc::BadRequest>(status);
  std::set<std::string> fields;
  for (const auto& violation : bad.field_violations()) fields.insert(violation.field());
  EXPECT_EQ(fields, (std::set<std::string>{"map_id", "preset", "config.voxel_size_m", "config.tracking.iou_threshold",
                                           "label_classes[1].kind"}));
}

TEST(Doors, MapsAreCreatedListedCountedAndDeleted) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  for (const char* name : {"b", "a"}) {
    ASSERT_OK_AND_ASSIGN(const auto response, server.Call(&MapStub::CreateMap, CreateRequest(name)));
    EXPECT_EQ(response.map().name(), std::string("maps/") + name);
    EXPECT_EQ(response.map().config().voxel_size_m(), 0.05);
    EXPECT_EQ(response.map().label_classes_size(), 3);
    EXPECT_EQ(response.revision(), 1);
    EXPECT_EQ(server.Call(&MapStub::CreateMap, CreateRequest(name)).code(), grpc::ALREADY_EXISTS);
  }
  ASSERT_OK(Feed(server, "a", 0, 3));
  ASSERT_OK_AND_ASSIGN(const auto list, server.Call(&MapStub::ListMaps));
  ASSERT_EQ(list.maps_size(), 2);
  EXPECT_EQ(list.maps(0).name(), "maps/a");
  EXPECT_EQ(list.maps(0).num_frames(), 3);

  ASSERT_OK_AND_ASSIGN(const auto stats, server.Call(&MapStub::GetMapStats, "maps/a"));
  EXPECT_EQ(stats.num_frames(), 3);
  EXPECT_GT(stats.num_observed_voxels(), 1000);
  EXPECT_EQ(stats.num_allocated_voxels(), stats.num_tsdf_blocks() * 512);
  EXPECT_GT(stats.memory_bytes_per_allocated_voxel(), 10);

  ASSERT_OK_AND_ASSIGN(const auto deleted, server.Call(&MapStub::DeleteMap, "maps/a"));
  EXPECT_GT(deleted.revision(), 1);
  EXPECT_EQ(server.Call(&MapStub::GetMap, "maps/a").code(), grpc::NOT_FOUND);
  EXPECT_EQ(store->ListMaps()->size(), 1u);
}

TEST(Doors, BadPointsAreRefused) {
  const auto store = MakeMemoryStore();
  TestServer server(*store, {}, {.max_query_points = 10});
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
  const auto query = [&server](const std::vector<float>& xyz) {
    v1::QueryPointsRequest request;
    request.set_map("maps/room");
    request.mutable_packed_points_m()->Add(xyz.begin(), xyz.end());
    return server.Call(&QueryStub::QueryPoints, request).status();
  };
  EXPECT_OK(query({1, 2, 3}));
  EXPECT_OK(query(std::vector<float>(30)));
  EXPECT_OK(query({}));
  EXPECT_EQ(query({1, 2}).error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(query(std::vector<float>(33)).error_code(), grpc::INVALID_ARGUMENT);
  const grpc::Status status = query({0, 0, 0, 0, std::numeric_limits<float>::infinity(), 0});
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_NE(status.error_details().find("point 1"), std::string::npos);
}

TEST(Doors, AMessageAboveTheLimitIsRefusedAndTheServerContinues) {
  const auto store = MakeMemoryStore();
  TestServer server(*store, {}, {.max_message_bytes = 1u << 20});
  v1::QueryPointsRequest request;
  request.set_map("maps/room");
  request.mutable_packed_points_m()->Resize(600'000, 0.0f);
  EXPECT_EQ(server.Call(&QueryStub::QueryPoints, request).code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_OK(server.Call(&MapStub::ListMaps));
}

TEST(Doors, APortInUseIsAnError) {
  const auto store = MakeMemoryStore();
  TestServer server(*store);
  const auto second =
      GrpcServer::Start({.address = "127.0.0.1:" + std::to_string(server.grpc().port())}, server.registry(), {});
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.status().code(), StatusCode::kUnavailable);
}

}  // namespace
}  // namespace dhpmap::testing
