// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

namespace dhpmap {

/// How many bytes gRPC takes in on a stream before anybody asks for a message, and before the client knows that it has
/// to wait (HTTP/2's initial window). No budget counts them, so those of 256 streams that nobody reads are to fit into
/// what is left for gRPC: a third of what requests and answers may take, `budget_bytes`. By default it is a part of a
/// file. Once a message is asked for, gRPC makes room for up to a MiB of it beyond this at a time: that is what a
/// stream over a long line brings in each round trip. At least what the protocol begins with, and no more than that
/// MiB.
constexpr int StreamWindow_bytes(std::size_t budget_bytes) {
  constexpr std::size_t kMostUnread = 256, kLeast_bytes = 65'535, kMost_bytes = std::size_t{1} << 20;
  return static_cast<int>(std::clamp(budget_bytes / 3 / kMostUnread, kLeast_bytes, kMost_bytes));
}

}  // namespace dhpmap
