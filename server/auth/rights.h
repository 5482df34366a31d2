// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

#include "mapping/base/status.h"
#include "server/auth/call_needs.h"
#include "server/auth/keys/principal.h"

namespace dhpmap::auth {

// Who may do what: pure functions of a principal and a call, asked before anything is looked up, so that no answer
// tells a stranger what there is. PERMISSION_DENIED for all that is not allowed.

/// Whether a role has what a call needs. Of calls that can only try, whether it might: see CheckRequest.
bool RoleHas(Role role, const CallNeeds& needs);
/// Before the request is read; reason ROLE_NOT_ALLOWED.
Status CheckRole(const Principal& principal, const CallNeeds& needs);

/// Of a map, by its id; reason MAP_NOT_ALLOWED, in the same words whether there is such a map or not.
Status CheckMap(const Principal& principal, std::string_view map_id);

/// Of one message of a call: its role again, now that it is known whether it only tries; the map that it names, if it
/// does; its session (NOT_YOUR_SESSION), and its author (NOT_YOUR_NAME), who is filled in where it is left empty.
Status CheckRequest(const Principal& principal, const CallNeeds& needs, google::protobuf::Message& request);

/// The map that a request names; empty: none.
std::string MapNamed(const CallNeeds& needs, const google::protobuf::Message& request);

/// Whether an edit of that author is the principal's own: its name, or its name with "/..." behind it.
bool IsOwnName(std::string_view principal, std::string_view author);

}  // namespace dhpmap::auth
