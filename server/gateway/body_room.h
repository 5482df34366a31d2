// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>

#include "server/base/byte_budget.h"
#include "server/base/request_limits.h"

namespace dhpmap::gateway {

/// The memory that one body takes while it is parsed, besides its own bytes; returned on destruction.
/// Thread-compatible.
class BodyRoom {
 public:
  /// `share` is empty, and of the budget that counts the body as well.
  BodyRoom(ByteShare share, std::size_t body_bytes) : share_(std::move(share)), body_bytes_(body_bytes) {}

  /// Sets the total to `num_bytes`. TOO_MANY_BYTES if the budget is spent now, BODY_TOO_LARGE if it never suffices.
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
