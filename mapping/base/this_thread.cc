// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/this_thread.h"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace dhpmap {
namespace {

/// What sched_setattr(2) takes, first version; glibc has none of it.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = 0;
  std::uint64_t flags = 0;
  std::int32_t niceness = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime_ns = 0;  ///< of an ordinary thread: its turns; 0 = as the system has them
  std::uint64_t deadline_ns = 0, period_ns = 0;
};

constexpr std::uint64_t kShortTurn_ns = 100'000;  // the shortest that the kernel grants

thread_local bool is_nicer = false;

bool ReadAttributes(SchedulingAttributes& attributes) {
  return syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) == 0;
}

}  // namespace

void NameThisThread(const char* name) {
  (void)pthread_setname_np(pthread_self(), name);  // refuses what is too long: then the process's name stays
}

void MakeThisThreadNicer(int by) {
  if (by <= 0) return;
  is_nicer = true;
  // On Linux a niceness is a thread's own.
  const int now = getpriority(PRIO_PROCESS, 0);
  (void)setpriority(PRIO_PROCESS, 0, now + by);
}

bool IsThisThreadNicer() { return is_nicer; }

bool TakeTurns(Turns turns) {
  SchedulingAttributes attributes;  // with the niceness that it has
  if (!ReadAttributes(attributes) || attributes.policy != SCHED_OTHER) return false;
  attributes.runtime_ns = turns == Turns::kShort ? kShortTurn_ns : 0;
  if (syscall(SYS_sched_setattr, 0, &attributes, 0) != 0) return false;
  // A kernel that knows nothing of it takes the call, and changes nothing.
  SchedulingAttributes granted;
  return ReadAttributes(granted) && (turns == Turns::kOrdinary || granted.runtime_ns == kShortTurn_ns);
}

}  // namespace dhpmap
