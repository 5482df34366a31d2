// SPDX-License-Identifier: BSD-3-Clause
#include "server/reload.h"

#include <chrono>

#include "server/config/command_line.h"
#include "server/log/log.h"

namespace dhpmap {
namespace {

void TellTls(const net::TlsContext& tls, const Status& reloaded) {
  if (reloaded.ok()) return LogInfo("TLS: now with the certificate of " + tls.Describe());
  LogError("TLS: goes on with the certificate of " + tls.Describe() + ": " + reloaded.ToString());
}

void ReloadConfig(const Launch& launch) {
  const auto now = ParseCommandLine(launch.arguments, launch.environment);
  if (!now.ok()) return LogError("settings stay as they are: " + now.status().ToString());
  if (const auto level = LogLevelFromName(now->config.log.level); level.ok()) SetLogLevel(*level);
  std::string waiting;
  for (const std::string& key : ChangedKeys(launch.config, now->config)) {
    if (key != "log.level") waiting += (waiting.empty() ? "" : ", ") + key;
  }
  if (!waiting.empty()) LogWarning("these settings have changed and wait for a restart: " + waiting);
}

}  // namespace

std::unique_ptr<net::TlsWatch> WatchTlsFiles(const std::shared_ptr<net::TlsContext>& tls) {
  if (tls == nullptr) return nullptr;
  LogInfo("TLS: with the certificate of " + tls->Describe());
  return std::make_unique<net::TlsWatch>(tls, std::chrono::seconds(1),
                                         [tls](const Status& reloaded) { TellTls(*tls, reloaded); });
}

void ReloadSettings(const Launch& launch, net::TlsContext* tls, auth::Gate& gate) {
  LogInfo("reading settings again");
  if (tls != nullptr) TellTls(*tls, tls->Reload());
  gate.Look();
  const Status reopened = gate.ReopenAudit();
  if (!reopened.ok()) LogError("the audit log goes on in its old file: " + reopened.ToString());
  ReloadConfig(launch);
}

}  // namespace dhpmap
