// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// A key for a map that is being imported. A lock that it holds on a connection of its own keeps the map's rows from
/// being swept; it ends with this object, with the process, and with the connection. Thread-compatible.
class IncomingMap {
 public:
  static Result<IncomingMap> Begin(const ConnectionOptions& options);
  IncomingMap(IncomingMap&&) = default;
  IncomingMap& operator=(IncomingMap&&) = delete;
  ~IncomingMap();

  [[nodiscard]] std::int64_t key() const { return key_; }

  /// Runs `calls` and commits, if the lock still holds: then the rows are those of a map for good. Call once.
  /// UNAVAILABLE if the connection is lost, or somebody else has swept them.
  Answers Finish(std::span<const Call> calls);

 private:
  IncomingMap(Connection connection, std::int64_t key) : connection_(std::move(connection)), key_(key) {}
  Connection connection_;
  std::int64_t key_;
};

/// Gives those that nobody holds to the sweeper. Returns how many.
Result<std::int64_t> GiveUpAbandoned(Connection& connection);

/// Whether a map of which Finish said nothing is there. Waits for a backend that still works on it.
Result<bool> HasArrived(Connection& connection, std::int64_t map_key);

}  // namespace dhpmap::postgres
