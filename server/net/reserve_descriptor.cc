// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/reserve_descriptor.h"

#include <fcntl.h>
#include <unistd.h>

namespace dhpmap::net {

bool ReserveDescriptor::Use() {
  if (descriptor_ < 0) return false;
  ::close(descriptor_);
  descriptor_ = -1;
  return true;
}

bool ReserveDescriptor::Fill() {
  if (descriptor_ < 0) descriptor_ = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  return descriptor_ >= 0;
}

}  // namespace dhpmap::net
