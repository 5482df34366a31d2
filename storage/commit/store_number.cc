// SPDX-License-Identifier: BSD-3-Clause
#include "storage/commit/store_number.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>

namespace dhpmap {

std::uint16_t NextStoreNumber() {
  static std::atomic<std::uint32_t> last = 0;
  const std::uint32_t number = last.fetch_add(1) + 1;
  return std::in_range<std::uint16_t>(number) ? static_cast<std::uint16_t>(number) : std::uint16_t{0};
}

int NumCodecThreads() {
  constexpr int kMaxThreads = 2;
  return std::min(kMaxThreads, std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

}  // namespace dhpmap
