// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "server/http/exchange.h"

namespace dhpmap {
class Lane;
}

namespace dhpmap::gateway {

/// Makes a page on `lane`, so that the connections' thread stays free; ignores the body. Skips the work if the client
/// disconnects before it starts.
std::shared_ptr<http::Exchange> MakePageExchange(std::function<http::Response()> make, Lane& lane,
                                                 std::shared_ptr<http::Responder> responder);

}  // namespace dhpmap::gateway
