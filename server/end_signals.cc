// SPDX-License-Identifier: BSD-3-Clause
#include "server/end_signals.h"

namespace dhpmap {
namespace {

bool IsIgnored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

sigset_t BlockEndSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) sigaddset(&signals, signal);
  if (!IsIgnored(SIGHUP)) sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  return signals;
}

int AwaitEnd(const sigset_t& signals, const std::function<void()>& on_hang_up) {
  int signal = 0;
  do {
    if (signal == SIGHUP) on_hang_up();
    sigwait(&signals, &signal);
  } while (signal == SIGHUP && on_hang_up);
  sigset_t impatient;
  sigemptyset(&impatient);
  sigaddset(&impatient, SIGTERM);
  sigaddset(&impatient, SIGINT);
  pthread_sigmask(SIG_UNBLOCK, &impatient, nullptr);
  return signal;
}

}  // namespace dhpmap
