// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace dhpmap::net {

/// How many of the sockets that were handed to somebody else, who does not tell when they are closed, are still open:
/// a descriptor that was closed, and perhaps given out again, does not name the same inode. Not thread-safe.
class OpenSockets {
 public:
  explicit OpenSockets(int most) : most_(static_cast<std::size_t>(most > 0 ? most : 1)) {}

  /// False if there are as many as there may be; then it is not one of them. Looks at all only if it seems so.
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
