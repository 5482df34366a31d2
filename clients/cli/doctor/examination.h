// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/cli/doctor/finding.h"
#include "dhpmap/options.h"

namespace dhpmap {

/// Examines a server as a client of this version sees it. If it is unreachable, the later checks are left out. `ca` as
/// for LookAtCertificate; `options` must match it.
std::vector<Finding> Examine(const std::string& address, const std::string& ca, const client::ConnectOptions& options,
                             const std::string& version);

/// A line each, followed by the advice.
std::string FindingsText(const std::vector<Finding>& findings);
/// {"health": "warn", "findings": [{"what", "health", "text", "advice"}]}.
std::string FindingsJson(const std::vector<Finding>& findings);

}  // namespace dhpmap
