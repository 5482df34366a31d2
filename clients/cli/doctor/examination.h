// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/cli/doctor/finding.h"
#include "dhpmap/options.h"

namespace dhpmap {

/// Looks at a server as a client of this version sees it. Where it cannot be reached the rest is left out. `ca` as of
/// LookAtCertificate; `options` say the same to the library.
std::vector<Finding> Examine(const std::string& address, const std::string& ca, const client::ConnectOptions& options,
                             const std::string& version);

/// A line each, and below it what to do.
std::string FindingsText(const std::vector<Finding>& findings);
/// {"health": "warn", "findings": [{"what", "health", "text", "advice"}]}.
std::string FindingsJson(const std::vector<Finding>& findings);

}  // namespace dhpmap
