// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace dhpmap {

enum class Health { kOk, kWarn, kFail };

/// The result of one check, with advice if something is wrong.
struct Finding {
  Health health = Health::kOk;
  std::string what;    ///< "disk"
  std::string text;    ///< "12 GiB of 100 GiB are free"
  std::string advice;  ///< empty: nothing to do
};

/// The worst health of all findings.
Health WorstOf(const std::vector<Finding>& findings);
/// "ok", "warn" or "fail".
const char* HealthName(Health health);

}  // namespace dhpmap
