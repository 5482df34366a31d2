// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/load/counted_memory.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

namespace dhpmap::rig {
namespace {

constexpr double kMiB = 1 << 20;
constexpr char kCounted[] = "dhpmap_memory_bytes";
constexpr std::chrono::milliseconds kPause{400};
constexpr std::chrono::seconds kUntilStarted{2};  // until lazily begun threads are there

/// How far a value is outside of an interval.
double Outside(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

}  // namespace

CountedMemory::CountedMemory(ServerUnderTest& server) : server_(server) {
  (void)server_.Metric(kCounted);  // what the first answer makes is there for good
  std::this_thread::sleep_for(kUntilStarted);
  const MemoryLook look = Look();
  of_libraries_mib_ = std::max(0.0, look.anonymous_mib - look.counted_mib);
}

MemoryLook CountedMemory::Look() const {
  const double before_mib = UseOf(server_.pid()).anonymous_mib;
  const double counted_mib = server_.Metric(kCounted) / kMiB;
  const double after_mib = UseOf(server_.pid()).anonymous_mib;
  MemoryLook look{.anonymous_mib = (before_mib + after_mib) / 2, .counted_mib = counted_mib};
  look.unexplained_mib = counted_mib == 0 ? look.anonymous_mib
                                          : Outside(counted_mib + of_libraries_mib_, std::min(before_mib, after_mib),
                                                    std::max(before_mib, after_mib));
  return look;
}

void CountedMemory::Tell() const {
  std::printf("   counted:");
  for (const char* kind : {"maps", "surfaces", "requests", "refinement", "meshing", "fusion", "store", "allocator"}) {
    std::string row(kCounted);
    row.append("{kind=\"").append(kind).append("\"}");
    const double bytes = server_.Metric(row);
    std::printf(" %s %.1f,", kind, bytes / kMiB);
  }
  std::printf(" without maps beside it %.1f MiB\n", of_libraries_mib_);
}

MemoryLooks::MemoryLooks(const CountedMemory& memory)
    : thread_([this, &memory](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          const MemoryLook look = memory.Look();
          {
            const MutexLock lock(mutex_);
            looks_.push_back(look);
          }
          std::this_thread::sleep_for(kPause);
        }
      }) {}

std::vector<MemoryLook> MemoryLooks::End() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  const MutexLock lock(mutex_);
  return looks_;
}

double UnexplainedInMost_percent(std::vector<MemoryLook> looks) {
  if (looks.empty()) return 100;
  const std::size_t at = (looks.size() - 1) * 9 / 10;
  std::nth_element(
      looks.begin(), looks.begin() + static_cast<std::ptrdiff_t>(at), looks.end(),
      [](const MemoryLook& a, const MemoryLook& b) { return a.unexplained_percent() < b.unexplained_percent(); });
  return looks[at].unexplained_percent();
}

}  // namespace dhpmap::rig
