// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/result.h"
#include "server/auth/gate.h"
#include "server/gateway/rpc_call.h"
#include "server/http/message.h"

namespace dhpmap::gateway {

/// Who sends a request, by its header Authorization, or by the cookie of a login; errors as of Gate::Authenticate.
/// Browsers send cookies unasked: with one, PERMISSION_DENIED, reason FOREIGN_ORIGIN, unless the browser says that a
/// page of this server sends it, whether it reads or writes.
Result<auth::PrincipalPtr> WhoAsks(auth::Gate& gate, const http::RequestHead& head);

/// POST /ui/login with a key in Authorization: 204 and a cookie in its place. POST /ui/logout ends it.
http::Response LogIn(auth::Gate& gate, const http::RequestHead& head);
http::Response LogOut(auth::Gate& gate, const http::RequestHead& head);
inline constexpr std::string_view kLogInPath = "/ui/login", kLogOutPath = "/ui/logout";

/// INVALID_ARGUMENT, reason TOKEN_IN_URL, for a key in the URL, which logs and histories would keep.
Status CheckNoKeyInUrl(std::string_view query);

/// Has the call made for `principal`, in place of whatever key the client showed: it goes no further.
void CallFor(auth::Gate& gate, auth::PrincipalPtr principal, CallOptions& call);

}  // namespace dhpmap::gateway
