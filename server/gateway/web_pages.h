// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "server/http/message.h"

namespace dhpmap::gateway {

/// The viewer at /ui/: embedded files, each with an ETag, and a Content-Security-Policy that restricts the page to
/// requests to this server and to its own scripts. Redirects /ui, and / for browsers (those that ask for HTML). Nothing
/// for other paths. Pure, thread-safe.
std::optional<http::Response> WebPage(const http::RequestHead& head, std::string_view path);

}  // namespace dhpmap::gateway
