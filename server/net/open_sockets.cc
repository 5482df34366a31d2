// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/open_sockets.h"

#include <sys/stat.h>

namespace dhpmap::net {
namespace {

/// 0 if the descriptor is not open.
ino_t InodeOf(int descriptor) {
  struct stat found {};
  return ::fstat(descriptor, &found) == 0 ? found.st_ino : 0;
}

}  // namespace

bool OpenSockets::Add(int socket) {
  if (known_.size() >= most_) {
    std::erase_if(known_, [](const Known& one) { return InodeOf(one.descriptor) != one.inode; });
  }
  if (known_.size() >= most_) return false;
  known_.push_back({socket, InodeOf(socket)});
  return true;
}

}  // namespace dhpmap::net
