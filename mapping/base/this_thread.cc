// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/this_thread.h"

#include <pthread.h>
#include <sys/resource.h>

namespace dhpmap {

void NameThisThread(const char* name) {
  (void)pthread_setname_np(pthread_self(), name);  // refuses what is too long: then the process's name stays
}

void MakeThisThreadNicer(int by) {
  if (by <= 0) return;
  // On Linux a niceness is a thread's own.
  const int now = getpriority(PRIO_PROCESS, 0);
  (void)setpriority(PRIO_PROCESS, 0, now + by);
}

}  // namespace dhpmap
