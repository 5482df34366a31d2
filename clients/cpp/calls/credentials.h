// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/security/credentials.h>

#include <memory>
#include <string>

#include "dhpmap/options.h"
#include "dhpmap/result.h"

namespace dhpmap::client {

/// How to talk to a server. InvalidArgument for files that cannot be read, and for a token that would go to another
/// machine in the clear.
Result<std::shared_ptr<grpc::ChannelCredentials>> CredentialsFor(const std::string& address,
                                                                 const ConnectOptions& options);

/// That of the options, or of their file; empty: none. InvalidArgument for a file that is open to others, or holds
/// none.
Result<std::string> TokenOf(const ConnectOptions& options);

}  // namespace dhpmap::client
