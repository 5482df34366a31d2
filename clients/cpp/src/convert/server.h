// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/server.h"
#include "dhpmap/v1/server_service.pb.h"

namespace dhpmap::client {

ServerStatus FromProto(const v1::GetServerStatusResponse& status);

}  // namespace dhpmap::client
