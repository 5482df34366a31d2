// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>

namespace dhpmap::net {

/// For the calling thread: OpenSSL writes to sockets in a way that would end the process when a client has gone.
inline void BlockPipeSignal() {
  sigset_t pipe;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
}

}  // namespace dhpmap::net
