// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "dhpmap/v1/watch_service.pb.h"
#include "dhpmap/watch.h"

namespace dhpmap::client {

/// Without its position.
Change ChangeOf(const v1::SubmapEvent& event, std::int64_t revision);

}  // namespace dhpmap::client
