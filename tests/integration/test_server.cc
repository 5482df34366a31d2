// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/test_server.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "tests/support/wire_frame.h"

namespace dhpmap::testing {
namespace {

template <typename T>
T ValueOrDie(Result<T> result) {
  if (!result.ok()) {
    std::cerr << result.status().ToString() << std::endl;
    std::abort();
  }
  return std::move(result).value();
}

/// Replaces timeouts that a test does not set, so that none expires on a busy machine.
constexpr double kLong_s = 1e6;

void BePatient(double& time_s, double default_s) {
  if (time_s == default_s) time_s = kLong_s;
}

GrpcOptions OnFreePort(GrpcOptions options) {
  options.address = "127.0.0.1:0";
  options.has_nice_threads = false;  // low-priority threads would hardly run on a busy machine
  BePatient(options.keepalive_s, GrpcOptions().keepalive_s);
  BePatient(options.import_idle_s, GrpcOptions().import_idle_s);
  return options;
}

OpenMapOptions WithOneThread(OpenMapOptions options) {
  options.mapping.num_threads = 1;
  BePatient(options.commit.max_behind_s, OpenMapOptions().commit.max_behind_s);
  BePatient(options.feeds.idle_s, OpenMapOptions().feeds.idle_s);
  return options;
}

/// Else gRPC reuses channels of earlier servers on the same port.
std::shared_ptr<grpc::Channel> OwnChannel(int port) {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(port), grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace

TestServer::Doors TestServer::Open(MapStore& store, OpenMapOptions session, GrpcOptions grpc, GrpcObserver observer,
                                   const RegistryOptions& registry_options) {
  auto registry = ValueOrDie(MapRegistry::Open(store, WithOneThread(std::move(session)), registry_options));
  auto door = ValueOrDie(GrpcServer::Start(OnFreePort(std::move(grpc)), *registry, std::move(observer)));
  door->SetServing(true);
  return {.registry = std::move(registry), .grpc = std::move(door)};
}

TestServer::TestServer(MapStore& store, OpenMapOptions session, GrpcOptions grpc, GrpcObserver observer,
                       const RegistryOptions& registry)
    : TestServer(Open(store, std::move(session), std::move(grpc), std::move(observer), registry)) {}

TestServer::TestServer(Doors doors) : Client(OwnChannel(doors.grpc->port())), doors_(std::move(doors)) {}

TestServer::~TestServer() { (void)Stop(0); }

Status TestServer::Stop(double grace_s) {
  doors_.grpc->Shutdown(grace_s);
  return doors_.registry->Shutdown();
}

Scene TestScene() {
  using Shape = Solid::Shape;
  return {
      .solids = {
          {.shape = Shape::kSphere, .center_m = {0, 0, 0.4}, .size_m = {0.4, 0, 0}, .segment = 1, .color = {200, 0, 0}},
          {.shape = Shape::kBox,
           .center_m = {1.2, 0.3, 0.3},
           .size_m = {0.3, 0.25, 0.3},
           .segment = 2,
           .color = {0, 200, 0}},
          {.shape = Shape::kHalfSpace,
           .center_m = {0, 0, 0},
           .size_m = {0, 0, 1},
           .segment = 3,
           .color = {0, 0, 200}}}};
}

v1::Frame TestFrame(int i) {
  const double angle = 0.25 * i;
  const Transform T_map_camera = LookAt({0.6 + 2.2 * std::cos(angle), 2.2 * std::sin(angle), 1.4}, {0.6, 0.1, 0.2});
  v1::Frame frame = ToWire(Render(TestScene(), SmallCamera(), T_map_camera));
  frame.set_stamp_ns(1'000'000'000LL + 100'000'000LL * i);
  for (std::uint32_t id = 1; id <= 3; ++id) {
    v1::Segment* segment = frame.add_segments();
    segment->set_id(id);
    segment->set_class_id(id);
    segment->set_score(0.9f);
  }
  return frame;
}

v1::CreateMapRequest CreateRequest(const std::string& map_id) {
  v1::CreateMapRequest request;
  request.set_map_id(map_id);
  request.mutable_config()->set_voxel_size_m(0.05);
  request.mutable_config()->set_truncation_m(0.1);
  request.mutable_config()->mutable_tracking()->set_min_points_medium(30);
  request.mutable_config()->mutable_tracking()->set_min_points_stuff(100);
  const std::shared_ptr<const LabelSet> label_set = MakeLabelSet(2, 1);
  for (const LabelClass& c : label_set->classes()) {
    v1::LabelClass* label = request.add_label_classes();
    label->set_id(c.id.value);
    label->set_name(c.name);
    label->set_kind(c.panoptic == Panoptic::kThing ? v1::LabelClass::THING : v1::LabelClass::STUFF);
  }
  return request;
}

FeedResult Feed(v1::MappingService::Stub& mapping, const std::string& map_id, int begin, int end,
                const std::function<v1::Frame(int)>& frame_of) {
  ::grpc::ClientContext context;
  auto stream = mapping.IntegrateFrames(&context);
  std::thread writer([&] {
    for (int i = begin; i < end; ++i) {
      v1::IntegrateFramesRequest request;
      if (i == begin) request.set_map("maps/" + map_id);
      request.set_sequence(i);
      *request.mutable_frame() = frame_of(i);
      if (!stream->Write(request)) break;
    }
    stream->WritesDone();
  });
  FeedResult result;
  v1::IntegrateFramesResponse ack;
  while (stream->Read(&ack)) result.acks.push_back(ack);
  writer.join();
  result.status = stream->Finish();
  return result;
}

v1::QueryPointsRequest TestQuery(const std::string& map_id) {
  v1::QueryPointsRequest request;
  request.set_map("maps/" + map_id);
  request.set_packed(true);
  constexpr double kSpacing_m = 0.07;
  for (int column = 0; column < 43; ++column) {
    for (int row = 0; row < 29; ++row) {
      for (int layer = 0; layer < 15; ++layer) {
        for (const double value : {-1 + kSpacing_m * column, -1 + kSpacing_m * row, -0.05 + kSpacing_m * layer}) {
          request.add_packed_points_m(static_cast<float>(value));
        }
      }
    }
  }
  return request;
}

}  // namespace dhpmap::testing
