// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/status.h>

#include "mapping/base/status.h"

namespace dhpmap {

/// The details hold a serialised google.rpc.Status: see ToProto(const Status&).
grpc::Status ToGrpc(const Status& status);

}  // namespace dhpmap
