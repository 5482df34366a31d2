// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/security/server_credentials.h>

#include <functional>
#include <memory>
#include <string>

#include "server/auth/gate.h"

namespace dhpmap {

/// Credentials of connections from outside. With keys, a call is checked when its headers arrive, before any message is
/// read. It is refused if it has no valid key, or if the key's role does not permit the method. `kind` is the
/// transport, `from` the address (as in Gate::AuthenticateFrom). A null gate admits every call.
std::shared_ptr<grpc::ServerCredentials> MakeDoorCredentials(std::shared_ptr<auth::Gate> gate,
                                                             grpc_local_connect_type kind,
                                                             std::function<std::string()> from);

}  // namespace dhpmap
