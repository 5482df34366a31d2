// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "dhpmap/status.h"
#include "google/rpc/status.pb.h"

namespace dhpmap::client {

Status Error(StatusCode code, std::string message);
/// The error for an argument that is wrong before anything is sent.
Status BadArgument(std::string field, std::string description);

/// The status of a call. If no server was reached, the message names `address`, unless that is empty.
Status StatusOf(const grpc::Status& status, const std::string& address);
/// The status that a message contains.
Status StatusOf(const google::rpc::Status& status);

/// Whether the same request may succeed a little later.
bool IsPassing(const Status& status);

}  // namespace dhpmap::client
