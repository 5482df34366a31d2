// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace dhpmap {

enum class Health { kOk, kWarn, kFail };

/// What was looked at, how it is, and what to do where it is not well.
struct Finding {
  Health health = Health::kOk;
  std::string what;    ///< "disk"
  std::string text;    ///< "12 GiB of 100 GiB are free"
  std::string advice;  ///< empty: nothing is to be done
};

/// The worst of them.
Health WorstOf(const std::vector<Finding>& findings);
/// "ok", "warn" or "fail".
const char* HealthName(Health health);

}  // namespace dhpmap
