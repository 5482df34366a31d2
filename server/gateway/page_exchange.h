// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "server/http/exchange.h"

namespace dhpmap {
class Lane;
}

namespace dhpmap::gateway {

/// Answers with a page that is made on `lane`, so that the connections' thread is free meanwhile; a body is let go.
/// A page whose client is gone before it is begun is never made.
std::shared_ptr<http::Exchange> MakePageExchange(std::function<http::Response()> make, Lane& lane,
                                                 std::shared_ptr<http::Responder> responder);

}  // namespace dhpmap::gateway
