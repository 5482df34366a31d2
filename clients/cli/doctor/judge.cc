// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/doctor/judge.h"

#include <algorithm>
#include <cmath>

#include "clients/cli/text_table.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kDay_s = 86'400;
constexpr std::int64_t kRenew_s = 14 * kDay_s;
constexpr double kClockWarn_s = 1, kClockFail_s = 60;
constexpr std::int64_t kMebibyte = 1 << 20;
/// Imports leave the same amount free.
constexpr std::int64_t kDiskFail_bytes = 256 * kMebibyte;
constexpr std::int64_t kDiskWarn_bytes = 1024 * kMebibyte;
/// An upgrade copies the database and needs this much more.
constexpr std::int64_t kBesideCopy_bytes = 64 * kMebibyte;

/// "0.2" of "0.2.0".
std::string MinorOf(const std::string& version) { return version.substr(0, version.rfind('.')); }

}  // namespace

Finding JudgeVersion(const std::string& client, const std::string& server) {
  Finding finding{.what = "version", .text = "dhpmap " + client + ", server " + server};
  if (MinorOf(client) == MinorOf(server)) return finding;
  finding.health = Health::kWarn;
  finding.advice = "use the client of the server's version: one may lack what the other has";
  return finding;
}

Finding JudgeCertificate(const CertificateSight& sight, std::int64_t now_s) {
  Finding finding{.health = Health::kFail, .what = "certificate"};
  if (!sight.is_tls) {
    finding.text = "the server does not speak TLS";
    finding.advice = "leave --ca away, or give the server tls.cert and tls.key (docs/tls.md)";
    return finding;
  }
  if (!sight.fault.empty()) {
    finding.text = "it is not to be trusted: " + sight.fault;
    finding.advice = sight.is_expired         ? "put a new one into the server's tls.cert, which it reads at once"
                     : sight.is_of_other_name ? "connect by a name that is in the certificate, or put this one into it"
                                              : "say with --ca who has signed it";
    return finding;
  }
  const std::int64_t left_s = sight.expires_s - now_s;
  finding.health = left_s < kRenew_s ? Health::kWarn : Health::kOk;
  finding.text = "it is good for " + std::to_string(std::max<std::int64_t>(left_s / kDay_s, 0)) + " days";
  if (left_s < kRenew_s)
    finding.advice = "renew it: put the new one into the server's tls.cert, which it reads at once";
  return finding;
}

Finding JudgeClock(double ahead_s, double within_s) {
  Finding finding{.what = "clock"};
  const double off_s = std::max(0.0, std::abs(ahead_s) - within_s);  // lower bound
  finding.text =
      off_s == 0 ? "the server's is that of this machine, to within " + Fixed(1e3 * std::max(within_s, 1e-3), 0) + " ms"
                 : "the server's is " + Fixed(std::abs(ahead_s), 3) + " s " + (ahead_s > 0 ? "ahead of" : "behind") +
                       " that of this machine";
  if (off_s <= kClockWarn_s) return finding;
  finding.health = off_s > kClockFail_s ? Health::kFail : Health::kWarn;
  finding.advice = "let both follow a time server (systemd-timesyncd, chrony): keys and certificates end by the clock";
  return finding;
}

Finding JudgeReadiness(bool is_ready) {
  if (is_ready) return {.what = "readiness", .text = "the server is ready"};
  return {.health = Health::kFail,
          .what = "readiness",
          .text = "the server is not ready",
          .advice = "it starts, ends, or cannot store what is fused: its log says which"};
}

Finding JudgeDisk(std::int64_t free_bytes, std::int64_t total_bytes, std::int64_t database_bytes) {
  Finding finding{.what = "disk"};
  if (free_bytes < 0) {
    finding.health = Health::kWarn;
    finding.text = "the server cannot tell how much is free";
    finding.advice = "look at the file system of its database";
    return finding;
  }
  finding.text = Bytes(static_cast<double>(free_bytes)) + " of " + Bytes(static_cast<double>(total_bytes)) +
                 " are free, the database has " + Bytes(static_cast<double>(database_bytes));
  if (free_bytes < kDiskFail_bytes) {
    finding.health = Health::kFail;
    finding.advice = "make room: frames are refused once the database cannot grow";
  } else if (free_bytes < kDiskWarn_bytes) {
    finding.health = Health::kWarn;
    finding.advice = "make room soon";
  } else if (free_bytes < database_bytes + kBesideCopy_bytes) {
    finding.health = Health::kWarn;
    finding.advice = "make room before an upgrade, which keeps a copy of the database";
  }
  return finding;
}

Finding JudgeSaving(double behind_s, double max_behind_s) {
  Finding finding{.what = "saving", .text = "all that is fused is stored"};
  if (behind_s > 0) finding.text = "the oldest frame that is not stored is " + Fixed(behind_s, 1) + " s old";
  if (behind_s > max_behind_s) {
    finding.health = Health::kFail;
    finding.advice = "frames are refused: the log says why commits fail, most likely the disk";
  } else if (behind_s > max_behind_s / 2) {
    finding.health = Health::kWarn;
    finding.advice = "beyond " + Fixed(max_behind_s, 0) + " s frames are refused: is the disk slow or full?";
  }
  return finding;
}

}  // namespace dhpmap
