// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <time.h>

namespace dhpmap::bench {

inline double CpuTimeOf_s(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What this thread, or all of this process, has had of the cores: others on the machine change it less than the time
/// of day.
inline double ThreadCpu_s() { return CpuTimeOf_s(CLOCK_THREAD_CPUTIME_ID); }
inline double ProcessCpu_s() { return CpuTimeOf_s(CLOCK_PROCESS_CPUTIME_ID); }

/// What this thread has of the cores for it.
template <typename Work>
double CpuOf_s(const Work& work) {
  const double start_s = ThreadCpu_s();
  work();
  return ThreadCpu_s() - start_s;
}

}  // namespace dhpmap::bench
