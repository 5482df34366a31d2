// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "server/auth/gate.h"

namespace dhpmap {

/// What the gateway serves besides the RPCs. Called on its threads, so functions must be thread-safe; is_ready must be
/// quick.
struct GatewayHooks {
  std::function<bool()> is_ready;              ///< /readyz
  std::function<std::string()> metrics_text;   ///< /metrics, Prometheus text; on a thread of its own
  std::shared_ptr<auth::Gate> gate = nullptr;  ///< access control; null: the server behind the channel decides
};

}  // namespace dhpmap
