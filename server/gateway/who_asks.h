// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/result.h"
#include "server/auth/gate.h"
#include "server/gateway/rpc_call.h"
#include "server/http/message.h"

namespace dhpmap::gateway {

/// Authenticates a request by its Authorization header or login cookie; errors as in Gate::Authenticate. Browsers send
/// cookies unasked, so a request with a cookie gets PERMISSION_DENIED, reason FOREIGN_ORIGIN, unless the browser states
/// that a page of this server sent it; this holds for reads, too.
Result<auth::PrincipalPtr> WhoAsks(auth::Gate& gate, const http::RequestHead& head);

/// POST /ui/login with a key in Authorization: 204, with a cookie in place of the key. POST /ui/logout ends the login.
http::Response LogIn(auth::Gate& gate, const http::RequestHead& head);
http::Response LogOut(auth::Gate& gate, const http::RequestHead& head);
inline constexpr std::string_view kLogInPath = "/ui/login", kLogOutPath = "/ui/logout";

/// INVALID_ARGUMENT, reason TOKEN_IN_URL, for a key in the URL: logs and browser histories would keep it.
Status CheckNoKeyInUrl(std::string_view query);

/// Makes the call for `principal` by a ticket. Removes the client's key, so that it goes no further.
void CallFor(auth::Gate& gate, auth::PrincipalPtr principal, CallOptions& call);

}  // namespace dhpmap::gateway
