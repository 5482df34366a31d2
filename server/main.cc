// SPDX-License-Identifier: BSD-3-Clause
// Wiring: store -> registry -> gRPC door -> REST door, until SIGTERM, SIGINT or SIGUSR1; SIGHUP reads settings again.
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/config/command_line.h"
#include "server/end_signals.h"
#include "server/gateway/gateway.h"
#include "server/grpc/grpc_server.h"
#include "server/log/log.h"
#include "server/metrics/metrics.h"
#include "server/options.h"
#include "server/reload.h"
#include "server/service/inherited_sockets.h"
#include "server/service/notifier.h"
#include "server/service/watchdog.h"
#include "server/start_check.h"
#include "storage/store.h"

namespace dhpmap {
namespace {

/// To as many file descriptors as we may have: most systems allow a process a thousand at first, and hundreds of
/// thousands if it asks. gRPC's door takes no more connections for good once it has met the limit.
void RaiseDescriptorLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return;
  limit.rlim_cur = limit.rlim_max;
  if (setrlimit(RLIMIT_NOFILE, &limit) != 0) LogWarning("the limit of file descriptors cannot be raised");
}

/// What both doors get besides their options.
struct Service {
  const Launch& launch;
  const service::Notifier& manager;
  const service::InheritedSockets& sockets;
  const sigset_t& signals;
};

/// As whoever started the server wants to know it.
std::string DoorsText(const ServerConfig& config, const GrpcServer& grpc, const Gateway& gateway) {
  return "gRPC on " + WithPort(config.grpc.address, grpc.port()) + ", REST on " +
         (config.tls.is_on() ? "https" : "http") + "://" + WithPort(config.http.address, gateway.port());
}

/// Fed by a task on the lane that answers queries; nothing if nobody watches.
std::optional<service::Watchdog> FeedWatchdog(const Service& service, GrpcServer& grpc) {
  const auto time = service::WatchdogTime(service.launch.environment, ::getpid());
  if (!time || !service.manager.is_heard()) return std::nullopt;
  return std::optional<service::Watchdog>(
      std::in_place, *time,
      service::LanePulse([&grpc](std::function<void()> work) { return grpc.PostQuick(std::move(work)); },
                         [&manager = service.manager] { manager.TellAlive(); }));
}

/// Tells that both doors are open, and waits for the end. Under a service manager, with TLS or with an audit log,
/// SIGHUP reads settings again; else it is that of a terminal that is closed, and ends the server.
int ServeUntilTold(const Service& service, const std::string& doors, net::TlsContext* tls, auth::Gate& gate) {
  std::printf("dhpmap-server: %s\n", doors.c_str());
  std::fflush(stdout);
  service.manager.TellReady(doors);
  std::function<void()> on_hang_up;
  if (tls != nullptr || gate.has_audit() || service.manager.is_heard()) {
    on_hang_up = [&, tls] {
      service.manager.TellReloading();
      ReloadSettings(service.launch, tls, gate);
      service.manager.TellReady(doors);
    };
  }
  return AwaitEnd(service.signals, on_hang_up);
}

Status Serve(const ServerConfig& config, const Service& service) {
  Metrics metrics;
  DHPMAP_ASSIGN_OR_RETURN(const auto store, OpenStore(config, [&manager = service.manager](const std::string& message) {
                            LogInfo(message);
                            manager.TellStarting(message);
                          }));
  DHPMAP_ASSIGN_OR_RETURN(const auto records, RecordDirOf(config));
  DHPMAP_ASSIGN_OR_RETURN(const auto spill, SpillOf(config));
  DHPMAP_ASSIGN_OR_RETURN(
      const auto registry,
      MapRegistry::Open(*store, OpenMapOptionsOf(config, metrics, records.get(), spill), RegistryOptionsOf(config)));
  const auto inflight = InflightBudgetOf(config);
  DHPMAP_ASSIGN_OR_RETURN(const auto gate, GateOf(config, store->fleet() != nullptr ? store->fleet()->Me().id : 0));
  DHPMAP_ASSIGN_OR_RETURN(const auto tls, TlsOf(config));
  const auto tls_watch = WatchTlsFiles(tls);
  GrpcOptions grpc_options = GrpcOptionsOf(config, inflight, gate, tls);
  grpc_options.sockets = service.sockets.grpc;
  grpc_options.fleet = store->fleet();
  DHPMAP_ASSIGN_OR_RETURN(const auto grpc, GrpcServer::Start(grpc_options, *registry, ObserverOf(metrics)));
  GatewayOptions gateway_options = GatewayOptionsOf(config, inflight, metrics, tls);
  gateway_options.sockets = service.sockets.rest;
  DHPMAP_ASSIGN_OR_RETURN(
      const auto gateway,
      Gateway::Start(
          gateway_options, grpc->InProcessChannel(),
          {.is_ready = [&] { return grpc->is_serving() && !IsStoreBehind(*registry, config.store.max_behind_s); },
           .metrics_text =
               [&] {
                 Metrics::Gauges gauges = GaugesOf(*registry, *inflight, *grpc, records.get(), spill.get());
                 gauges.is_insecure = IsInsecure(config);
                 gauges.num_audit_dropped = gate->num_audit_dropped();
                 if (const Fleet* fleet = store->fleet()) gauges.fleet = FleetGaugesOf(*fleet, registry->followed());
                 return metrics.Text(gauges);
               },
           .gate = gate}));
  if (Fleet* const fleet = store->fleet()) fleet->Announce(FleetAddressOf(config, grpc->port()));
  grpc->SetServing(true);
  auto watchdog = FeedWatchdog(service, *grpc);
  const int signal = ServeUntilTold(service, DoorsText(config, *grpc, *gateway), tls.get(), *gate);
  LogInfo("got signal " + std::to_string(signal) + ": ending streams, storing what is fused");
  service.manager.TellStopping("storing what is fused");
  watchdog.reset();
  if (const Status given = registry->HandAllOver(); !given.ok()) LogWarning(given.ToString());
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(config.shutdown_grace_s);
  grpc->Drain();
  gateway->Shutdown(config.shutdown_grace_s);
  const std::chrono::duration<double> left = end - std::chrono::steady_clock::now();  // one grace for both doors
  grpc->Shutdown(std::max(0.0, left.count()));
  return registry->Shutdown();
}

int RefuseToStart(const Status& status) {
  std::fprintf(stderr, "dhpmap-server: %s\n", status.ToString().c_str());
  return 2;
}

int Main(const std::vector<std::string>& arguments, const std::vector<std::string>& environment) {
  const auto invocation = ParseCommandLine(arguments, environment);
  if (!invocation.ok()) return RefuseToStart(invocation.status());
  if (invocation->is_done) {
    std::fputs(invocation->text.c_str(), stdout);
    return 0;
  }
  ServerConfig config = invocation->config;
  const auto sockets = service::SocketsIn(environment, ::getpid());
  if (!sockets.ok()) return RefuseToStart(sockets.status());
  if (const Status used = UseAddressesOf(*sockets, config); !used.ok()) return RefuseToStart(used);
  (void)umask(077);  // maps, records and spilled tiles are for the server's user alone
  if (invocation->is_check) return TellCheck(CheckStart(config, *sockets));
  LogOptions log = LogOptionsOf(config);
  log.is_journal = IsJournal(service::ValueIn(environment, "JOURNAL_STREAM"));
  InitLog(log);
  RaiseDescriptorLimit();
  const service::Notifier manager(service::ValueIn(environment, "NOTIFY_SOCKET"));
  const Launch launch{.arguments = arguments, .environment = environment, .config = invocation->config};
  const sigset_t signals = BlockEndSignals();
  const Status status = Serve(config, {launch, manager, *sockets, signals});
  if (!status.ok()) {
    LogError(status.ToString());
    manager.TellStopping(status.ToString());
  }
  if (status.reason() == Reason("BAD_CONFIG")) return 2;  // as one that is known to be so before the database is asked
  return status.ok() ? 0 : 1;
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) {
  std::vector<std::string> environment;
  for (char** variable = environ; *variable != nullptr; ++variable) environment.emplace_back(*variable);
  return dhpmap::Main({argv + 1, argv + argc}, environment);
}
