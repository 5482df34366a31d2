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

/// A whole server but its process: registry and gRPC door over a store that the test holds, reached over TCP. It fuses
/// with one thread, and gives nobody up for being slow, unless the options say when.
class TestServer : public Client {
 public:
  explicit TestServer(MapStore& store, OpenMapOptions session = {}, GrpcOptions grpc = {}, GrpcObserver observer = {},
                      const RegistryOptions& registry = {});
  /// Waits for no call.
  ~TestServer();

  /// As after SIGTERM; OK if everything is in the store. Calls go on for as long as only what hangs needs.
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

/// A ball and a box (things 1 and 2) on a floor (stuff 3), seen from all around.
Scene TestScene();
/// Frame i of a walk around TestScene, with its segment table, as a client would send it: raw images.
v1::Frame TestFrame(int i);

/// A map over the classes of TestScene.
v1::CreateMapRequest CreateRequest(const std::string& map_id);

/// What came back for a stream of frames.
struct FeedResult {
  std::vector<v1::IntegrateFramesResponse> acks;
  grpc::Status status;
};
/// Sends frames [begin, end), of the walk unless told otherwise, to maps/{map_id}, reading acknowledgements meanwhile.
FeedResult Feed(v1::MappingService::Stub& mapping, const std::string& map_id, int begin, int end,
                const std::function<v1::Frame(int)>& frame_of = TestFrame);
inline FeedResult Feed(TestServer& server, const std::string& map_id, int begin, int end) {
  return Feed(*server.mapping, map_id, begin, end);
}

/// A grid of points through TestScene.
v1::QueryPointsRequest TestQuery(const std::string& map_id);

}  // namespace dhpmap::testing
