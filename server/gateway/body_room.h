// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>

#include "server/base/byte_budget.h"
#include "server/base/request_limits.h"

namespace dhpmap::gateway {

/// What one body takes while it is made into a request, beside its own bytes, until this goes. Thread-compatible.
class BodyRoom {
 public:
  /// `share` is empty, of the budget that counts the body as well.
  BodyRoom(ByteShare share, std::size_t body_bytes) : share_(std::move(share)), body_bytes_(body_bytes) {}

  /// Asks for so many in all: TOO_MANY_BYTES if there are not, BODY_TOO_LARGE if there never are.
  Status Hold(std::size_t num_bytes) {
    if (IsSmallRequest(body_bytes_, num_bytes, share_.budget())) return Status::Ok();
    DHPMAP_RETURN_IF_ERROR(CheckEverFits(body_bytes_ + num_bytes, share_.budget()));
    return share_.Resize(num_bytes) ? Status::Ok() : TooManyBytes();
  }

 private:
  ByteShare share_;
  std::size_t body_bytes_;
};

}  // namespace dhpmap::gateway
