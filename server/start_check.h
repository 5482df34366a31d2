// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "server/config/server_config.h"
#include "server/service/inherited_sockets.h"

namespace dhpmap {

/// Puts the addresses of sockets that were handed over in place of those in the configuration, which then says where
/// the doors are, and looks at it again. INVALID_ARGUMENT if other machines reach one without TLS or keys.
Status UseAddressesOf(const service::InheritedSockets& sockets, ServerConfig& config);

struct StartCheck {
  std::vector<std::string> faults;  ///< each would stop the start
  std::vector<std::string> notes;   ///< what a start would do
};

/// Looks at all that a start opens, as the user that runs it: certificate, keys, database, folders, ports. Changes
/// nothing. Ports and database of a server that runs on the same database are taken for its own: then the check is for
/// a restart. `config` is valid.
StartCheck CheckStart(const ServerConfig& config, const service::InheritedSockets& sockets);

/// Prints it; the exit code: 0, or 2 if there is a fault.
int TellCheck(const StartCheck& check);

}  // namespace dhpmap
