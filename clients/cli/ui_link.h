// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace dhpmap {

/// "robot:50051" -> "http://robot:8080": the port that the REST door has unless it was told otherwise, on the host of
/// the gRPC door. Of what names no host ("unix:...") this machine.
std::string HttpOf(std::string_view grpc_address);

/// The viewer's link to a map, as maps/{map} or its id; empty: the map that was changed last. `http`: with or without
/// "http://" and a "/" at its end.
std::string UiLink(std::string_view http, std::string_view map);

}  // namespace dhpmap
