// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/cli/doctor/certificate.h"
#include "clients/cli/doctor/finding.h"
#include "dhpmap/server.h"

namespace dhpmap {

// Judgements of what was observed: pure functions.

/// Versions such as "0.2.0": MAJOR and MINOR should be equal (docs/compatibility.md).
Finding JudgeVersion(const std::string& client, const std::string& server);

/// Fails if no client could connect; warns during the last fourteen days.
Finding JudgeCertificate(const CertificateSight& sight, std::int64_t now_s);

/// `ahead_s`: offset of the server's clock from ours; its uncertainty is `within_s`.
Finding JudgeClock(double ahead_s, double within_s);

Finding JudgeReadiness(bool is_ready);
Finding JudgeDisk(std::int64_t free_bytes, std::int64_t total_bytes, std::int64_t database_bytes);
Finding JudgeSaving(double behind_s, double max_behind_s);
/// One finding for each feed with a problem, or one for all feeds.
std::vector<Finding> JudgeFeeds(const std::vector<client::ActiveFeed>& feeds);

}  // namespace dhpmap
