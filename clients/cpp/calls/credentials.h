// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/security/credentials.h>

#include <memory>
#include <string>

#include "dhpmap/options.h"
#include "dhpmap/result.h"

namespace dhpmap::client {

/// The credentials of a connection. InvalidArgument for unreadable files, and for a token that would be sent
/// unencrypted to another machine.
Result<std::shared_ptr<grpc::ChannelCredentials>> CredentialsFor(const std::string& address,
                                                                 const ConnectOptions& options);

/// The token of the options, or of their file; empty: none. InvalidArgument for a file that others may read, or that
/// holds no token.
Result<std::string> TokenOf(const ConnectOptions& options);

}  // namespace dhpmap::client
