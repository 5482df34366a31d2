// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace dhpmap::net {

/// Counts sockets that were handed over and are still open, although nobody reports when they close. A descriptor that
/// was closed, and perhaps reused, no longer has the same inode. Not thread-safe.
class OpenSockets {
 public:
  explicit OpenSockets(int most) : most_(static_cast<std::size_t>(most > 0 ? most : 1)) {}

  /// False if the limit is reached; then the socket is not counted. Checks for closed ones only at the limit.
  bool Add(int socket);

 private:
  struct Known {
    int descriptor;
    ino_t inode;
  };
  std::size_t most_;
  std::vector<Known> known_;
};

}  // namespace dhpmap::net
