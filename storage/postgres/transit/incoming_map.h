// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// The key of a map that is being imported. A lock on a connection of its own protects the map's rows from sweeping.
/// The lock ends with this object, the process or the connection. Thread-compatible.
class IncomingMap {
 public:
  static Result<IncomingMap> Begin(const ConnectionOptions& options);
  IncomingMap(IncomingMap&&) = default;
  IncomingMap& operator=(IncomingMap&&) = delete;
  ~IncomingMap();

  [[nodiscard]] std::int64_t key() const { return key_; }

  /// Runs `calls` and commits if the lock still holds; the rows then belong to a map. Call once. UNAVAILABLE if the
  /// connection was lost or another process has swept the rows.
  Answers Finish(std::span<const Call> calls);

 private:
  IncomingMap(Connection connection, std::int64_t key) : connection_(std::move(connection)), key_(key) {}
  Connection connection_;
  std::int64_t key_;
};

/// Hands abandoned imports to the sweeper. Returns their number.
Result<std::int64_t> GiveUpAbandoned(Connection& connection);

/// Whether the map exists, if the answer of Finish was lost. Waits for a backend that still works on it.
Result<bool> HasArrived(Connection& connection, std::int64_t map_key);

}  // namespace dhpmap::postgres
