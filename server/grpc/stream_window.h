// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

namespace dhpmap {

/// How many bytes gRPC receives on a stream before the server asks for a message (HTTP/2's initial window). No budget
/// counts them. So the windows of 256 unread streams are to fit into the share of gRPC's own buffers: a third of
/// `budget_bytes`, the budget of requests and answers. The default is one part of a file. Once the server asks for a
/// message, gRPC receives up to 1 MiB of it beyond the window: this limits the bytes per round trip of a stream over a
/// slow link. At least the protocol's default window, at most 1 MiB.
constexpr int StreamWindow_bytes(std::size_t budget_bytes) {
  constexpr std::size_t kMostUnread = 256, kLeast_bytes = 65'535, kMost_bytes = std::size_t{1} << 20;
  return static_cast<int>(std::clamp(budget_bytes / 3 / kMostUnread, kLeast_bytes, kMost_bytes));
}

}  // namespace dhpmap
