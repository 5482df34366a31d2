// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/grpc/grpc_server.h"
#include "storage/store.h"
#include "tests/support/client.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// A server without a process of its own: registry and gRPC door over the test's store, reached over TCP. It fuses with
/// one thread, and has no timeouts for slow clients unless the options set them.
class TestServer : public Client {
 public:
  explicit TestServer(MapStore& store, OpenMapOptions session = {}, GrpcOptions grpc = {}, GrpcObserver observer = {},
                      const RegistryOptions& registry = {});
  /// Does not wait for calls.
  ~TestServer();

  /// Shuts down as after SIGTERM; OK if everything is stored. The grace period is so long that only calls that hang
  /// exceed it.
  Status Stop() { return Stop(std::chrono::duration<double>(kPatience).count()); }
  Status Stop(double grace_s);

  [[nodiscard]] GrpcServer& grpc() { return *doors_.grpc; }
  [[nodiscard]] MapRegistry& registry() { return *doors_.registry; }

  const std::unique_ptr<MapStub> maps = std::make_unique<MapStub>(channel());
  const std::unique_ptr<MappingStub> mapping = std::make_unique<MappingStub>(channel());
  const std::unique_ptr<SubmapStub> submaps = std::make_unique<SubmapStub>(channel());
  const std::unique_ptr<QueryStub> queries = std::make_unique<QueryStub>(channel());
  const std::unique_ptr<WatchStub> watches = std::make_unique<WatchStub>(channel());

 private:
  struct Doors {
    std::unique_ptr<MapRegistry> registry;
    std::unique_ptr<GrpcServer> grpc;
  };
  static Doors Open(MapStore& store, OpenMapOptions session, GrpcOptions grpc, GrpcObserver observer,
                    const RegistryOptions& registry);
  explicit TestServer(Doors doors);

  const Doors doors_;
};

/// A ball and a box (things 1 and 2) on a floor (stuff 3), seen from all sides.
Scene TestScene();
/// Frame i of a walk around TestScene, with its segment table, as raw images.
v1::Frame TestFrame(int i);

/// A map with the classes of TestScene.
v1::CreateMapRequest CreateRequest(const std::string& map_id);

/// The result of a stream of frames.
struct FeedResult {
  std::vector<v1::IntegrateFramesResponse> acks;
  grpc::Status status;
};
/// Sends frames [begin, end), by default of the walk, to maps/{map_id} and reads the acknowledgements meanwhile.
FeedResult Feed(v1::MappingService::Stub& mapping, const std::string& map_id, int begin, int end,
                const std::function<v1::Frame(int)>& frame_of = TestFrame);
inline FeedResult Feed(TestServer& server, const std::string& map_id, int begin, int end) {
  return Feed(*server.mapping, map_id, begin, end);
}

/// A grid of points through TestScene.
v1::QueryPointsRequest TestQuery(const std::string& map_id);

}  // namespace dhpmap::testing
