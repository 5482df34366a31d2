// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/history_id.h"

#include <random>

namespace dhpmap {

std::uint64_t DrawHistoryId() {
  std::random_device device;
  std::uint64_t id = 0;
  while (id == 0) id = (std::uint64_t{device()} << 32 | device()) >> 1;
  return id;
}

}  // namespace dhpmap
