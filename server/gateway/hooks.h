// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace dhpmap {

/// What the gateway serves besides the RPCs. Called on its threads; must be thread-safe, and is_ready quick.
struct GatewayHooks {
  std::function<bool()> is_ready;             ///< /readyz
  std::function<std::string()> metrics_text;  ///< /metrics, Prometheus text; on a thread of its own
};

}  // namespace dhpmap
