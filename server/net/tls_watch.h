// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"
#include "server/net/tls_context.h"

namespace dhpmap::net {

/// Reloads a TlsContext when its files change; a thread checks them every `period`. Thread-safe.
class TlsWatch {
 public:
  /// `on_reload` gets the result of every reload, on the thread.
  TlsWatch(std::shared_ptr<TlsContext> tls, std::chrono::milliseconds period,
           std::function<void(const Status&)> on_reload);
  ~TlsWatch();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::net
