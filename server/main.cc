// SPDX-License-Identifier: BSD-3-Clause
// Wiring: store -> registry -> gRPC door -> REST door, until SIGTERM, SIGINT, SIGHUP or SIGUSR1.
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "server/config/command_line.h"
#include "server/gateway/gateway.h"
#include "server/grpc/grpc_server.h"
#include "server/log/log.h"
#include "server/metrics/metrics.h"
#include "server/net/tls_watch.h"
#include "server/options.h"
#include "storage/store.h"

namespace dhpmap {
namespace {

bool IsIgnored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Blocks the signals that end the server in this thread and all it starts, for WaitForSignal to take. Under nohup
/// SIGHUP stays ignored.
sigset_t BlockEndSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) sigaddset(&signals, signal);
  if (!IsIgnored(SIGHUP)) sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  return signals;
}

void TellReload(const net::TlsContext& tls, const Status& reloaded) {
  if (reloaded.ok()) return LogInfo("TLS: now with the certificate of " + tls.Describe());
  LogError("TLS: goes on with the certificate of " + tls.Describe() + ": " + reloaded.ToString());
}

/// What logrotate has renamed is left, and what TLS reads is read again.
void Refresh(net::TlsContext* tls, auth::Gate& gate) {
  if (tls != nullptr) TellReload(*tls, tls->Reload());
  const Status reopened = gate.ReopenAudit();
  if (!reopened.ok()) LogError("the audit log goes on in its old file: " + reopened.ToString());
}

/// With TLS or an audit log, SIGHUP reads or opens its files again, as service managers have it; without either, it
/// ends the server.
/// From here on a second SIGTERM or SIGINT ends the process at once. A second SIGHUP does not: a terminal that is
/// closed sends more than one.
int WaitForSignal(const sigset_t& signals, net::TlsContext* tls, auth::Gate& gate) {
  int signal = 0;
  do {
    if (signal == SIGHUP) Refresh(tls, gate);
    sigwait(&signals, &signal);
  } while (signal == SIGHUP && (tls != nullptr || gate.has_audit()));
  sigset_t impatient;
  sigemptyset(&impatient);
  sigaddset(&impatient, SIGTERM);
  sigaddset(&impatient, SIGINT);
  pthread_sigmask(SIG_UNBLOCK, &impatient, nullptr);
  return signal;
}

/// To as many file descriptors as we may have: most systems allow a process a thousand at first, and hundreds of
/// thousands if it asks. gRPC's door takes no more connections for good once it has met the limit.
void RaiseDescriptorLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return;
  limit.rlim_cur = limit.rlim_max;
  if (setrlimit(RLIMIT_NOFILE, &limit) != 0) LogWarning("the limit of file descriptors cannot be raised");
}

std::unique_ptr<net::TlsWatch> WatchFiles(const std::shared_ptr<net::TlsContext>& tls) {
  if (tls == nullptr) return nullptr;
  LogInfo("TLS: with the certificate of " + tls->Describe());
  return std::make_unique<net::TlsWatch>(tls, std::chrono::seconds(1),
                                         [tls](const Status& reloaded) { TellReload(*tls, reloaded); });
}

Status Serve(const ServerConfig& config, const sigset_t& signals) {
  Metrics metrics;
  DHPMAP_ASSIGN_OR_RETURN(const auto store, OpenSqliteStore(config.db, StoreOptionsOf(config)));
  DHPMAP_ASSIGN_OR_RETURN(const auto records, RecordDirOf(config));
  DHPMAP_ASSIGN_OR_RETURN(const auto spill, SpillOf(config));
  DHPMAP_ASSIGN_OR_RETURN(
      const auto registry,
      MapRegistry::Open(*store, OpenMapOptionsOf(config, metrics, records.get(), spill), RegistryOptionsOf(config)));
  for (const MapSummary& map : registry->List()) {
    if (!map.damage.ok()) LogError("map '" + map.info.name + "' cannot be served: " + map.damage.ToString());
  }
  const auto inflight = InflightBudgetOf(config);
  DHPMAP_ASSIGN_OR_RETURN(const auto gate, GateOf(config));
  DHPMAP_ASSIGN_OR_RETURN(const auto tls, TlsOf(config));
  const auto tls_watch = WatchFiles(tls);
  DHPMAP_ASSIGN_OR_RETURN(
      const auto grpc, GrpcServer::Start(GrpcOptionsOf(config, inflight, gate, tls), *registry, ObserverOf(metrics)));
  DHPMAP_ASSIGN_OR_RETURN(
      const auto gateway,
      Gateway::Start(
          GatewayOptionsOf(config, inflight, metrics, tls), grpc->InProcessChannel(),
          {.is_ready = [&] { return grpc->is_serving() && !IsStoreBehind(*registry, config.store.max_behind_s); },
           .metrics_text =
               [&] {
                 Metrics::Gauges gauges = GaugesOf(*registry, *inflight, *grpc, records.get(), spill.get());
                 gauges.is_insecure = IsInsecure(config);
                 return metrics.Text(gauges);
               },
           .gate = gate}));
  grpc->SetServing(true);
  std::printf("dhpmap-server: gRPC on %s, REST on %s://%s\n", WithPort(config.grpc.address, grpc->port()).c_str(),
              tls != nullptr ? "https" : "http", WithPort(config.http.address, gateway->port()).c_str());
  std::fflush(stdout);

  const int signal = WaitForSignal(signals, tls.get(), *gate);
  LogInfo("got signal " + std::to_string(signal) + ": ending streams, storing what is fused");
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(config.shutdown_grace_s);
  grpc->Drain();
  gateway->Shutdown(config.shutdown_grace_s);
  const std::chrono::duration<double> left = end - std::chrono::steady_clock::now();  // one grace for both doors
  grpc->Shutdown(std::max(0.0, left.count()));
  return registry->Shutdown();
}

int Main(const std::vector<std::string>& arguments, const std::vector<std::string>& environment) {
  const auto invocation = ParseCommandLine(arguments, environment);
  if (!invocation.ok()) {
    std::fprintf(stderr, "dhpmap-server: %s\n", invocation.status().ToString().c_str());
    return 2;
  }
  if (invocation->is_done) {
    std::fputs(invocation->text.c_str(), stdout);
    return 0;
  }
  InitLog(LogOptionsOf(invocation->config));
  (void)umask(077);  // maps, records and spilled tiles are for the server's user alone
  RaiseDescriptorLimit();
  const Status status = Serve(invocation->config, BlockEndSignals());
  if (!status.ok()) LogError(status.ToString());
  return status.ok() ? 0 : 1;
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) {
  std::vector<std::string> environment;
  for (char** variable = environ; *variable != nullptr; ++variable) environment.emplace_back(*variable);
  return dhpmap::Main({argv + 1, argv + argc}, environment);
}
