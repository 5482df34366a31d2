// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/grpc_server.h"

#include <grpc/support/log.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <limits>
#include <utility>
#include <vector>

#include "server/grpc/services.h"
#include "server/log/log.h"

namespace dhpmap {

struct GrpcServer::Impl {
  Impl(const GrpcOptions& grpc_options, MapRegistry& registry, GrpcObserver grpc_observer)
      : options(grpc_options),
        observer(std::move(grpc_observer)),
        context{registry, pool, options, observer},
        pool(std::max(1, grpc_options.num_threads)) {
    services.push_back(MakeMapService(context));
    services.push_back(MakeMappingService(context, streams));
    services.push_back(MakeSubmapService(context));
    services.push_back(MakeQueryService(context));
  }

  GrpcOptions options;
  GrpcObserver observer;
  ServiceContext context;
  HandlerPool pool;  // its threads read what is above
  IntegrateStreams streams;
  std::vector<std::unique_ptr<grpc::Service>> services;
  int port = 0;
  std::atomic<bool> is_serving = false;
  std::unique_ptr<grpc::Server> server;  // the first to go
};

namespace {

constexpr std::array kServiceNames = {"", "dhpmap.v1.MapService", "dhpmap.v1.MappingService", "dhpmap.v1.SubmapService",
                                      "dhpmap.v1.QueryService"};

/// gRPC tells of its inner life on standard error; what matters of it comes back to us as a status.
void LogFromGrpc(gpr_log_func_args* line) { LogDebug(std::string("grpc: ") + line->message); }

}  // namespace

Result<std::unique_ptr<GrpcServer>> GrpcServer::Start(const GrpcOptions& options, MapRegistry& registry,
                                                      GrpcObserver observer) {
  gpr_set_log_function(LogFromGrpc);
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  auto impl = std::make_unique<Impl>(options, registry, std::move(observer));
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  grpc::ServerBuilder builder;
  builder.AddListeningPort(options.address, grpc::InsecureServerCredentials(), &impl->port);
  builder.SetMaxReceiveMessageSize(static_cast<int>(std::min(options.max_message_bytes, kMost)));
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);  // else a second server on the port would go unnoticed
  for (const auto& service : impl->services) builder.RegisterService(service.get());
  impl->server = builder.BuildAndStart();
  if (impl->server == nullptr || impl->port == 0) {
    return Unavailable("cannot listen for gRPC on " + options.address + ": in use, or not an address of this machine")
        .WithReason("CANNOT_BIND");
  }
  std::unique_ptr<GrpcServer> server(new GrpcServer(std::move(impl)));
  server->SetServing(false);
  return server;
}

GrpcServer::GrpcServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

GrpcServer::~GrpcServer() { Shutdown(0); }

int GrpcServer::port() const { return impl_->port; }

void GrpcServer::SetServing(bool is_serving) {
  auto* health = impl_->server->GetHealthCheckService();
  impl_->is_serving = is_serving;
  for (const char* service : kServiceNames) health->SetServingStatus(service, is_serving);
}

bool GrpcServer::is_serving() const { return impl_->is_serving; }

std::shared_ptr<grpc::Channel> GrpcServer::InProcessChannel() {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  return impl_->server->InProcessChannel(arguments);
}

void GrpcServer::Drain() {
  SetServing(false);
  impl_->streams.StopAll();
}

void GrpcServer::Shutdown(double grace_s) {
  Drain();
  const auto grace =
      std::chrono::duration_cast<std::chrono::system_clock::duration>(std::chrono::duration<double>(grace_s));
  impl_->server->Shutdown(std::chrono::system_clock::now() + grace);
  impl_->server->Wait();
}

}  // namespace dhpmap
