// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace dhpmap {

/// "robot:50051" -> "http://robot:8080": the default REST port on the host of the gRPC door. An address without a host
/// ("unix:...") means this machine.
std::string HttpOf(std::string_view grpc_address);

/// The viewer's link to a map (maps/{map} or its id); empty: the map that was changed last. `http` may omit "http://"
/// and may end with "/".
std::string UiLink(std::string_view http, std::string_view map);

}  // namespace dhpmap
