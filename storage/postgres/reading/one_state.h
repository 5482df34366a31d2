// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// A transaction that reads one state of the database. The destructor ends it.
class OneState {
 public:
  static Result<OneState> Begin(Connection& connection);
  OneState(OneState&& other) noexcept : connection_(std::exchange(other.connection_, nullptr)) {}
  OneState& operator=(OneState&&) = delete;
  ~OneState();

 private:
  explicit OneState(Connection& connection) : connection_(&connection) {}
  Connection* connection_;
};

}  // namespace dhpmap::postgres
