// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "dhpmap/options.h"
#include "dhpmap/v1/query_options.pb.h"

namespace dhpmap::client {

/// For a query of `map`, maps/{map}. `may_touch`: further allowed contacts of the whole robot.
v1::QueryOptions ToProto(const QueryOptions& options, const std::string& map,
                         std::span<const ObjectOrClass> may_touch = {});

}  // namespace dhpmap::client
