// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/cli/doctor/certificate.h"
#include "clients/cli/doctor/finding.h"
#include "dhpmap/server.h"

namespace dhpmap {

// What is well and what is not: pure functions of what was seen.

/// Versions as "0.2.0": MAJOR and MINOR are to be the same (docs/compatibility.md).
Finding JudgeVersion(const std::string& client, const std::string& server);

/// Fails where no client would connect; warns for the last fourteen days.
Finding JudgeCertificate(const CertificateSight& sight, std::int64_t now_s);

/// `ahead_s`: of the server's clock before ours; known to within `within_s`.
Finding JudgeClock(double ahead_s, double within_s);

Finding JudgeReadiness(bool is_ready);
Finding JudgeDisk(std::int64_t free_bytes, std::int64_t total_bytes, std::int64_t database_bytes);
Finding JudgeSaving(double behind_s, double max_behind_s);
/// One a feed that is not well, or one for all.
std::vector<Finding> JudgeFeeds(const std::vector<client::ActiveFeed>& feeds);

}  // namespace dhpmap
