// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/gateway.h"

#include <chrono>

#include "mapping/base/mutex.h"
#include "server/base/lane.h"
#include "server/gateway/dispatcher.h"
#include "server/gateway/rpc_call.h"
#include "server/gateway/shared_answers.h"
#include "server/http/server.h"

namespace dhpmap {
namespace {

constexpr std::chrono::seconds kCancelTimeout{5};
/// The niceness of bulk calls at the gRPC door.
constexpr int kBulkNiceness = 15;
/// As many decoder threads, and as nice, as at the gRPC door.
constexpr int kFrameThreads = 2, kFrameNiceness = 5;

}  // namespace

struct Gateway::Impl {
  Impl(const GatewayOptions& options, std::shared_ptr<grpc::Channel> channel, gateway::HttpRuleRouter router,
       GatewayHooks hooks)
      : caller(std::move(channel)),
        dispatcher(std::move(router), {&caller, &bulk, &shared, &frames, &pages}, std::move(hooks),
                   options.max_body_bytes, options.inflight, gateway::AllowedOrigins(options.allowed_origins)) {}

  enum class State { kServing, kShutDown, kStuck };  // kStuck: shut down, but something still refers to this

  gateway::RpcCaller caller;
  gateway::SharedAnswers shared;
  gateway::Dispatcher dispatcher;
  std::unique_ptr<http::Server> server;
  Mutex mutex;
  State state DHPMAP_GUARDED_BY(mutex) = State::kServing;
  // Last, so that their threads end before the objects that they use.
  Lane bulk{{.name = "json", .num_threads = 1, .niceness = kBulkNiceness}};
  Lane frames{{.name = "json frames", .num_threads = kFrameThreads, .niceness = kFrameNiceness}};
  Lane pages{{.name = "metrics"}};
};

Result<std::unique_ptr<Gateway>> Gateway::Start(const GatewayOptions& options, std::shared_ptr<grpc::Channel> channel,
                                                GatewayHooks hooks) {
  DHPMAP_ASSIGN_OR_RETURN(gateway::HttpRuleRouter router, gateway::HttpRuleRouter::FromLinkedServices());
  auto impl = std::make_unique<Impl>(options, std::move(channel), std::move(router), std::move(hooks));
  const http::ServerOptions server_options{.address = options.address,
                                           .sockets = options.sockets,
                                           .tls = options.tls,
                                           .on_refused = options.on_refused,
                                           .num_threads = options.num_threads,
                                           .allowed_hosts = options.allowed_hosts,
                                           .max_connections = options.max_connections,
                                           .idle_timeout = std::chrono::duration<double>(options.idle_timeout_s),
                                           .head_timeout = std::chrono::duration<double>(options.head_timeout_s)};
  DHPMAP_ASSIGN_OR_RETURN(impl->server, http::Server::Start(server_options, impl->dispatcher));
  return std::unique_ptr<Gateway>(new Gateway(std::move(impl)));
}

Gateway::Gateway(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Gateway::~Gateway() {
  Shutdown(0);
  const bool is_stuck = [this] {
    const MutexLock lock(impl_->mutex);
    return impl_->state == Impl::State::kStuck;
  }();
  if (is_stuck) (void)impl_.release();  // a leak at shutdown is better than a crash
}

int Gateway::port() const { return impl_->server->port(); }

void Gateway::Shutdown(double grace_s) {
  const MutexLock lock(impl_->mutex);
  if (impl_->state != Impl::State::kServing) return;
  const bool connections_ended = impl_->server->Shutdown(std::chrono::duration<double>(grace_s));
  // Cancelled calls end at once on this side, but their final events still come through the server's threads.
  const bool calls_ended = impl_->caller.WaitUntilIdle(kCancelTimeout);
  impl_->state = connections_ended && calls_ended ? Impl::State::kShutDown : Impl::State::kStuck;
}

}  // namespace dhpmap
