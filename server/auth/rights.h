// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

#include "mapping/base/status.h"
#include "server/auth/call_needs.h"
#include "server/auth/keys/principal.h"

namespace dhpmap::auth {

// Authorization: pure functions of a principal and a call. They run before any lookup, so no answer reveals what
// exists. PERMISSION_DENIED for everything that is not allowed.

/// Whether a role allows a call. For calls that may be validate-only, whether it might: see CheckRequest.
bool RoleHas(Role role, const CallNeeds& needs);
/// Before the request is read. Reason ROLE_NOT_ALLOWED.
Status CheckRole(const Principal& principal, const CallNeeds& needs);

/// Checks access to a map by its id. Reason MAP_NOT_ALLOWED, with the same message whether or not the map exists.
Status CheckMap(const Principal& principal, std::string_view map_id);

/// Checks one message of a call: the role again, now that validate_only is known; the map, if it names one; the session
/// (NOT_YOUR_SESSION); the author (NOT_YOUR_NAME). Fills in an empty author.
Status CheckRequest(const Principal& principal, const CallNeeds& needs, google::protobuf::Message& request);

/// The map that a request names; empty if it names none.
std::string MapNamed(const CallNeeds& needs, const google::protobuf::Message& request);

/// Whether the author is the principal itself: its name, alone or followed by "/...".
bool IsOwnName(std::string_view principal, std::string_view author);

}  // namespace dhpmap::auth
