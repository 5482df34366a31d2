// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "server/http/message.h"

namespace dhpmap::gateway {

/// The viewer, at /ui/: its files as they are in the program, with an ETag each, and a Content-Security-Policy that
/// lets the page load and ask nothing but this server, and run no script but its own. Nothing for another path; a
/// redirect from /ui, and from / for who asks for HTML: a browser. Pure, thread-safe.
std::optional<http::Response> WebPage(const http::RequestHead& head, std::string_view path);

}  // namespace dhpmap::gateway
