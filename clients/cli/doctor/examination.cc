// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/doctor/examination.h"

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "clients/cli/doctor/certificate.h"
#include "clients/cli/doctor/judge.h"
#include "clients/cli/printable.h"
#include "clients/cli/text_table.h"
#include "dhpmap/client.h"

namespace dhpmap {
namespace {

using SystemClock = std::chrono::system_clock;

double Seconds(SystemClock::duration time) { return std::chrono::duration<double>(time).count(); }

Finding Unreached(const std::string& address, const std::string& ca, const client::Status& status) {
  Finding finding{.health = Health::kFail, .what = "connection", .text = "no server answers at " + address};
  if (status.code != client::StatusCode::kUnavailable) {  // nothing was tried
    finding.text = status.message;
    finding.advice = "see what --ca and --token-file name";
    return finding;
  }
  const bool wants_tls = ca.empty() && LookAtCertificate(address, "").is_tls;
  finding.advice = wants_tls
                       ? "the server speaks TLS: say with --ca whom to trust"
                       : "is dhpmap-server running there, and does a firewall let you through? Say where with --server";
  return finding;
}

Finding Refused(const client::Status& status) {
  Finding finding{.health = Health::kFail, .what = "connection", .text = status.ToString()};
  switch (status.code) {
    case client::StatusCode::kUnauthenticated:
      finding.advice = "say with --token-file where a key is that is good; `dhpmap keys` makes one";
      break;
    case client::StatusCode::kUnimplemented:
      finding.health = Health::kWarn;
      finding.text = "the server is older than this client, and cannot tell how it is";
      finding.advice = "bring the server up to date, or use the client of its version";
      break;
    default: finding.advice = "the server's log says more";
  }
  return finding;
}

void AddStatus(const client::ServerStatus& status, SystemClock::time_point asked, SystemClock::time_point answered,
               const std::string& version, std::vector<Finding>& findings) {
  const SystemClock::duration way = (answered - asked) / 2;
  findings.push_back(
      {.what = "connection", .text = "the server answers within " + Fixed(1e3 * Seconds(2 * way), 1) + " ms"});
  findings.push_back(JudgeVersion(version, status.version));
  findings.push_back(JudgeClock(Seconds(status.time - (asked + way)), Seconds(way)));
  findings.push_back(JudgeReadiness(status.is_ready));
  findings.push_back(JudgeDisk(status.disk_free_bytes, status.disk_total_bytes, status.database_bytes));
  findings.push_back(JudgeSaving(status.behind_s, status.max_behind_s));
  for (Finding& feed : JudgeFeeds(status.feeds)) findings.push_back(std::move(feed));
}

}  // namespace

std::vector<Finding> Examine(const std::string& address, const std::string& ca, const client::ConnectOptions& options,
                             const std::string& version) {
  std::vector<Finding> findings;
  if (!ca.empty() && ca != "system" && !std::ifstream(ca).good()) {
    return {{.health = Health::kFail,
             .what = "certificate",
             .text = "cannot read " + ca,
             .advice = "say with --ca where a PEM file is of who has signed the server's certificate"}};
  }
  if (!ca.empty()) {
    const CertificateSight sight = LookAtCertificate(address, ca);
    if (sight.is_reached) {
      const std::int64_t now_s =
          std::chrono::duration_cast<std::chrono::seconds>(SystemClock::now().time_since_epoch()).count();
      findings.push_back(JudgeCertificate(sight, now_s));
      if (findings.back().health == Health::kFail) return findings;
    }
  }
  const auto server = client::Client::Connect(address, options);
  if (!server.ok()) {
    findings.push_back(Unreached(address, ca, server.status()));
    return findings;
  }
  (void)server->GetStatus();  // the first call includes connecting and would distort the round trip
  const auto asked = SystemClock::now();
  const auto status = server->GetStatus();
  const auto answered = SystemClock::now();
  if (status.ok()) AddStatus(*status, asked, answered, version, findings);
  else findings.push_back(Refused(status.status()));
  return findings;
}

std::string FindingsText(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    std::string name = HealthName(finding.health);
    name.resize(6, ' ');
    text += name + finding.what + ": " + Printable(finding.text) + "\n";
    if (!finding.advice.empty()) text += std::string(6, ' ') + finding.advice + "\n";
  }
  return text;
}

std::string FindingsJson(const std::vector<Finding>& findings) {
  nlohmann::ordered_json all = {{"health", HealthName(WorstOf(findings))}, {"findings", nlohmann::json::array()}};
  for (const Finding& finding : findings) {
    all["findings"].push_back(nlohmann::ordered_json{{"what", finding.what},
                                                     {"health", HealthName(finding.health)},
                                                     {"text", finding.text},
                                                     {"advice", finding.advice}});
  }
  return all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace dhpmap
