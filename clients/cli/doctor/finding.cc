// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/doctor/finding.h"

#include <algorithm>

namespace dhpmap {

Health WorstOf(const std::vector<Finding>& findings) {
  Health worst = Health::kOk;
  for (const Finding& finding : findings) worst = std::max(worst, finding.health);
  return worst;
}

const char* HealthName(Health health) {
  switch (health) {
    case Health::kOk: return "ok";
    case Health::kWarn: return "warn";
    case Health::kFail: return "fail";
  }
  return "fail";
}

}  // namespace dhpmap
