// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <functional>

namespace dhpmap {

/// Blocks the signals that end the server in this thread and all it starts, for AwaitEnd to take: SIGTERM, SIGINT,
/// SIGUSR1 and SIGHUP. Under nohup SIGHUP stays ignored.
sigset_t BlockEndSignals();

/// Waits for one that ends the server. `on_hang_up`, on this thread, is what SIGHUP does instead of ending it; may be
/// empty. From then on a second SIGTERM or SIGINT ends the process at once. A second SIGHUP does not: a terminal that
/// is closed sends more than one.
int AwaitEnd(const sigset_t& signals, const std::function<void()>& on_hang_up);

}  // namespace dhpmap
