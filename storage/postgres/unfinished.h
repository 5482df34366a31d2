// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

class Connection::Unfinished {
 public:
  explicit Unfinished(Connection& connection) : connection_(&connection) {}
  ~Unfinished() {
    if (connection_ != nullptr) connection_->GiveUp();
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  void Dismiss() { connection_ = nullptr; }

 private:
  Connection* connection_;
};

}  // namespace dhpmap::postgres
