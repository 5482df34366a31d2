// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"
#include "server/net/tls_context.h"

namespace dhpmap::net {

/// Reads the files of a TlsContext again when they change, on a thread of its own that looks every `period`.
/// Thread-safe.
class TlsWatch {
 public:
  /// `on_reload` hears of every try, on the thread.
  TlsWatch(std::shared_ptr<TlsContext> tls, std::chrono::milliseconds period,
           std::function<void(const Status&)> on_reload);
  ~TlsWatch();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::net
