// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/grpc_server.h"

#include <google/protobuf/message.h>
#include <grpc/support/log.h>
#include <grpcpp/alarm.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <limits>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "grpc/health/v1/health.pb.h"
#include "server/grpc/door_call.h"
#include "server/grpc/entrance.h"
#include "server/grpc/map_quota.h"
#include "server/grpc/passing_time.h"
#include "server/grpc/reflection_service.h"
#include "server/grpc/relay/relay.h"
#include "server/grpc/services.h"
#include "server/grpc/stream_window.h"
#include "server/log/log.h"
#include "server/net/door.h"
#include "server/net/refusal.h"

namespace dhpmap {

namespace {

constexpr std::size_t kMaxWaiting = 1024;
/// Each step of niceness is a factor of 1.25. 10 steps more than fusion and decoding give those nine tenths of a busy
/// core. Quick answers get nearly all of it.
constexpr int kBulkNiceness = 15;
/// One motion is one piece and may take seconds. Beyond the number of cores the kernel schedules the threads.
constexpr int kLeastCheckThreads = 4;
constexpr int kFrameThreads = 2;
/// With 5 a busy core runs quick answers three quarters of the time.
constexpr int kDecodingNiceness = 5;
constexpr int kDecodingThreads = 2;
constexpr int kLoadThreads = 4;  // maps that are read from disk at a time
/// Per client connection; the client holds back further calls.
constexpr int kMaxStreamsPerConnection = 128;
/// Clients may send pings, but not more often.
constexpr int kMinClientPing_ms = 5'000;
/// A client that connects but sends nothing is disconnected after this.
constexpr int kHandshake_ms = 20'000;

int BulkThreads(const GrpcOptions& options) {
  return options.num_bulk_threads > 0 ? options.num_bulk_threads
                                      : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int Milliseconds(double seconds) { return static_cast<int>(seconds * 1e3); }

/// gRPC checks the size of a compressed message before it unpacks it: 64 KiB of zipped zeros would take 64 MiB that no
/// budget counts. Compressed requests are answered UNIMPLEMENTED.
void RefuseCompressed(grpc::ServerBuilder& builder) {
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_DEFLATE, false);
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_GZIP, false);
}

/// Limits what a connection may cost: memory of unread data, streams, and the time for which an unresponsive peer keeps
/// its resources.
void LimitConnections(const GrpcOptions& options, grpc::ServerBuilder& builder) {
  // When this quota is used up, gRPC resets streams without a reason. So it is larger than our budget, which refuses
  // first and says why.
  const std::size_t limit_bytes = options.inflight->limit_bytes();
  grpc::ResourceQuota quota("dhpmap");
  builder.SetResourceQuota(quota.Resize(limit_bytes + limit_bytes / 2));
  // Else gRPC estimates the bandwidth and receives up to 4 MiB of each unread stream.
  builder.AddChannelArgument(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES,
                             StreamWindow_bytes(options.inflight->limit_bytes()));
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, kMaxStreamsPerConnection);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, Milliseconds(options.keepalive_s));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, Milliseconds(options.keepalive_s));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);  // no limit
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, kHandshake_ms);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, kMinClientPing_ms);
}

Lane MakeLane(LaneOptions options) {
  options.on_exception = [name = options.name](const char* what) {
    LogError(std::string("a task of the lane '") + name + "' has thrown: " + what);
  };
  return Lane(options);
}

constexpr std::array kServiceNames = {"dhpmap.v1.MapService",  "dhpmap.v1.MappingService", "dhpmap.v1.SubmapService",
                                      "dhpmap.v1.EditService", "dhpmap.v1.QueryService",   "dhpmap.v1.WatchService",
                                      "dhpmap.v1.AuthService", "dhpmap.v1.ServerService",  "dhpmap.v1.FleetService"};
constexpr const char* kHealthService = "grpc.health.v1.Health";  // gRPC's own

std::vector<std::unique_ptr<grpc::Service>> MakeServices(const ServiceContext& context, IntegrateStreams& streams,
                                                         OpenStreams& query_streams, WatchStreams& watch_streams,
                                                         OpenStreams& reflection_streams) {
  std::vector<std::unique_ptr<grpc::Service>> services;
  services.push_back(MakeMapService(context));
  services.push_back(MakeMappingService(context, streams));
  services.push_back(MakeSubmapService(context));
  services.push_back(MakeEditService(context));
  services.push_back(MakeQueryService(context, query_streams));
  services.push_back(MakeWatchService(context, watch_streams));
  services.push_back(MakeAuthService(context));
  services.push_back(MakeServerService(context));
  services.push_back(MakeFleetService(context));
  std::vector<std::string> served(kServiceNames.begin(), kServiceNames.end());
  served.emplace_back(kHealthService);
  for (auto& service : MakeReflectionServices(context, reflection_streams, std::move(served))) {
    services.push_back(std::move(service));
  }
  return services;
}

}  // namespace

struct GrpcServer::Impl {
  Impl(const GrpcOptions& grpc_options, MapRegistry& registry, GrpcObserver grpc_observer)
      : options(grpc_options),
        observer(std::move(grpc_observer)),
        held(*options.inflight, [&registry](const MapSnapshot& state) { return registry.PresentOf(state); }),
        quota(*options.gate, registry),
        context{registry, lanes, options, observer, held, num_checks, quota, &is_serving},
        relay(MakeRelay(context)),
        streams(options.inflight->limit_bytes()),
        services(MakeServices(context, streams, query_streams, watch_streams, reflection_streams)),
        lanes{.quick = MakeLane({.name = "quick",
                                 .num_threads = options.num_threads,
                                 .max_waiting = kMaxWaiting,
                                 .turns = Turns::kShort}),
              .loads = MakeLane({.name = "loads", .num_threads = kLoadThreads, .max_waiting = kMaxWaiting}),
              .answers = MakeLane({.name = "answers", .turns = Turns::kShort}),
              .bulk = MakeLane({.name = "bulk",
                                .num_threads = BulkThreads(options),
                                .max_waiting = kMaxWaiting,
                                .niceness = options.has_nice_threads ? kBulkNiceness : 0}),
              .checks = MakeLane({.name = "checks",
                                  .num_threads = std::max(kLeastCheckThreads, 2 * BulkThreads(options)),
                                  .max_waiting = kMaxWaiting,
                                  .niceness = options.has_nice_threads ? kBulkNiceness : 0}),
              .frames = MakeLane({.name = "frames", .num_threads = kFrameThreads}),
              .decoding = MakeLane({.name = "decoding",
                                    .num_threads = kDecodingThreads,
                                    .niceness = options.has_nice_threads ? kDecodingNiceness : 0}),
              .watch = MakeLane({.name = "watch"})} {
    LetLanesMeet();
  }

  /// The services use it, so it is made before them.
  static std::unique_ptr<Relay> MakeRelay(ServiceContext& shared) {
    if (shared.options.fleet == nullptr) return nullptr;
    auto made = std::make_unique<Relay>(shared);
    shared.relay = made.get();
    return made;
  }

  /// Lanes post to one another, and a lane's threads start before the next lane is made. gRPC admits no call before all
  /// lanes exist. ThreadSanitizer cannot see that, so one task per lane establishes the order.
  void LetLanesMeet() {
    for (Lane* lane : {&lanes.quick, &lanes.loads, &lanes.answers, &lanes.bulk, &lanes.checks, &lanes.frames,
                       &lanes.decoding, &lanes.watch}) {
      lane->Post([] {});
    }
  }

  GrpcOptions options;
  GrpcObserver observer;
  PinnedSnapshots held;
  std::atomic<int> num_checks = 0;
  MapQuota quota;
  ServiceContext context;
  std::unique_ptr<Relay> relay;  // null: the server belongs to no fleet
  IntegrateStreams streams;
  OpenStreams query_streams;
  WatchStreams watch_streams;
  OpenStreams reflection_streams;
  std::vector<std::unique_ptr<grpc::Service>> services;
  std::unique_ptr<Entrance> entrance;
  std::unique_ptr<net::Door> door;  // hands its connections to the entrance
  std::atomic<bool> is_serving = false;
  std::unique_ptr<grpc::Server> server;
  Lanes lanes;  // last: its threads use the other members
};

namespace {

/// gRPC's own listener stops for good when file descriptors run out, and accepts any number of connections. Its HTTP/2
/// lacks the defences against floods found since 2023, and its TLS accepts a key that does not match the certificate.
/// So a door of ours accepts, and gRPC gets one end of a socket pair.
Result<std::unique_ptr<net::Door>> OpenDoor(const GrpcOptions& options, const GrpcObserver& observer) {
  auto door = net::Door::Open({.name = "gRPC",
                               .address = options.address,
                               .sockets = options.sockets,
                               .max_connections = options.max_connections,
                               .protocol = net::Protocol::kHttp2,
                               .tls = options.tls,
                               .on_refused = [on_refused = observer.on_refused](net::Refusal why) {
                                 if (on_refused) on_refused("grpc", net::RefusalName(why));
                               }});
  if (!door.ok()) return Status(door.status()).WithReason("CANNOT_BIND");
  return door;
}

std::shared_ptr<grpc::Channel> InsideChannel(grpc::Server& server) {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  return server.InProcessChannel(arguments);
}

/// gRPC logs to standard error. Errors that matter also come back as a status.
void LogFromGrpc(gpr_log_func_args* line) { LogDebug(std::string("grpc: ") + line->message); }

}  // namespace

Result<std::unique_ptr<GrpcServer>> GrpcServer::Start(const GrpcOptions& options, MapRegistry& registry,
                                                      GrpcObserver observer) {
  gpr_set_log_function(LogFromGrpc);
  grpc::EnableDefaultHealthCheckService(true);
  DHPMAP_RETURN_IF_ERROR(options.gate->CheckCalls());
  google::protobuf::LinkMessageReflection<grpc::health::v1::HealthCheckRequest>();  // for reflection
  auto impl = std::make_unique<Impl>(options, registry, std::move(observer));
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  grpc::ServerBuilder builder;
  DHPMAP_ASSIGN_OR_RETURN(impl->door, OpenDoor(options, impl->observer));
  impl->entrance = std::make_unique<Entrance>(options.gate, builder);
  builder.SetMaxReceiveMessageSize(static_cast<int>(std::min(options.max_message_bytes, kMost)));
  RefuseCompressed(builder);
  builder.SetContextAllocator(MakeCallAllocator());
  LimitConnections(options, builder);
  for (const auto& service : impl->services) builder.RegisterService(service.get());
  (void)TakeTurns(Turns::kShort);  // for gRPC's threads and those that they start
  impl->server = builder.BuildAndStart();
  (void)TakeTurns(Turns::kOrdinary);
  if (impl->server == nullptr) return Internal("gRPC does not start");
  if (impl->relay != nullptr) impl->relay->SetHere(InsideChannel(*impl->server));
  impl->door->Start([entrance = impl->entrance.get()](const net::Passed& passed) { entrance->Let(passed); });
  std::unique_ptr<GrpcServer> server(new GrpcServer(std::move(impl)));
  server->SetServing(false);
  return server;
}

GrpcServer::GrpcServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

GrpcServer::~GrpcServer() { Shutdown(0); }

int GrpcServer::port() const { return impl_->door->port(); }

void GrpcServer::SetServing(bool is_serving) {
  auto* health = impl_->server->GetHealthCheckService();
  impl_->is_serving = is_serving;
  health->SetServingStatus("", is_serving);
  for (const char* service : kServiceNames) health->SetServingStatus(service, is_serving);
}

bool GrpcServer::is_serving() const { return impl_->is_serving; }
std::size_t GrpcServer::frame_bytes() const { return impl_->streams.frame_bytes(); }
int GrpcServer::num_running_checks() const { return impl_->num_checks; }

bool GrpcServer::PostQuick(std::function<void()> work) {
  return impl_->lanes.quick.TryPost(std::make_shared<LaneTask>(std::move(work)));
}

std::shared_ptr<grpc::Channel> GrpcServer::InProcessChannel() { return InsideChannel(*impl_->server); }

void GrpcServer::Drain() {
  SetServing(false);
  impl_->streams.StopAll();
  impl_->query_streams.StopAll();
  impl_->watch_streams.StopAll();
  impl_->reflection_streams.StopAll();
}

void GrpcServer::Shutdown(double grace_s) {
  Drain();
  impl_->door->StopAccepting();
  impl_->entrance->Close();
  const gpr_timespec end =
      GrpcTimeIn(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(grace_s)));
  grpc::Alarm giving_up;
  const auto has_given_up = std::make_shared<std::promise<void>>();
  giving_up.Set(end, [&registry = impl_->context.registry, has_given_up](bool is_time) {
    if (is_time) registry.GiveUpMapping();
    has_given_up->set_value();
  });
  impl_->server->Shutdown(end);
  impl_->server->Wait();
  if (impl_->relay != nullptr) impl_->relay->SetHere(nullptr);
  // The alarm may be running now. Wait for it, because it uses the registry.
  giving_up.Cancel();
  has_given_up->get_future().wait();
}

}  // namespace dhpmap
