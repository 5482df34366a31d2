// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "mapping/base/result.h"
#include "server/rest/http_connection.h"

namespace dhpmap::rest {

/// Accepts TCP connections and runs them on its threads. Thread-safe.
class HttpServer {
 public:
  /// `on_connection` runs on the new connection's sequence of execution.
  using OnConnection = std::function<void(std::shared_ptr<Connection>)>;

  /// UNAVAILABLE if "host:port" cannot be bound; INVALID_ARGUMENT if it is no address.
  static Result<std::unique_ptr<HttpServer>> Start(const std::string& address, int num_threads,
                                                   OnConnection on_connection);
  /// Stops at once. Connections and what they hold must be gone.
  ~HttpServer();

  [[nodiscard]] int port() const;
  void StopAccepting();

 private:
  struct Impl;
  explicit HttpServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::rest
