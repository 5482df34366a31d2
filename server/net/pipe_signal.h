// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>

namespace dhpmap::net {

/// Blocks SIGPIPE in the calling thread: OpenSSL's writes would end the process after a client disconnects.
inline void BlockPipeSignal() {
  sigset_t pipe;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
}

}  // namespace dhpmap::net
