// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/security/server_credentials.h>

#include <functional>
#include <memory>
#include <string>

#include "server/auth/gate.h"

namespace dhpmap {

/// Of connections from outside. With keys each call is looked at when its head is there, and is refused before any of
/// its messages is taken in: no key, or a key whose role does not have what the call needs. `kind` is how they come,
/// `from` says from which address (as Gate::AuthenticateFrom has it). The gate may be null: none.
std::shared_ptr<grpc::ServerCredentials> MakeDoorCredentials(std::shared_ptr<auth::Gate> gate,
                                                             grpc_local_connect_type kind,
                                                             std::function<std::string()> from);

}  // namespace dhpmap
