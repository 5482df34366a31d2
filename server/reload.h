// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "server/auth/gate.h"
#include "server/config/server_config.h"
#include "server/net/tls_context.h"
#include "server/net/tls_watch.h"

namespace dhpmap {

/// Reads the files of TLS again as they change, and logs it. Null without TLS.
std::unique_ptr<net::TlsWatch> WatchTlsFiles(const std::shared_ptr<net::TlsContext>& tls);

/// What the server was started with.
struct Launch {
  std::vector<std::string> arguments, environment;
  ServerConfig config;  ///< as these and the file said at the start
};

/// Reads again what a running server can take: the files of TLS (may be null), the keys, and `log.level`. Opens the
/// audit log again, which logrotate may have renamed. Logs which other settings have changed and wait for a restart. A
/// file that cannot be used changes nothing; the log says why.
void ReloadSettings(const Launch& launch, net::TlsContext* tls, auth::Gate& gate);

}  // namespace dhpmap
