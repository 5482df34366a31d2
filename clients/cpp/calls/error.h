// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "dhpmap/status.h"
#include "google/rpc/status.pb.h"

namespace dhpmap::client {

Status Error(StatusCode code, std::string message);
/// A mistake that was found before anything was sent.
Status BadArgument(std::string field, std::string description);

/// What a call came to; of one that met no server also where that was looked for, unless `address` is empty.
Status StatusOf(const grpc::Status& status, const std::string& address);
/// What a message tells.
Status StatusOf(const google::rpc::Status& status);

/// Whether the same request may be answered a little later.
bool IsPassing(const Status& status);

}  // namespace dhpmap::client
