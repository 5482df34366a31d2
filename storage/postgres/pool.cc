// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/pool.h"

namespace dhpmap::postgres {

Result<Pool::Lease> Pool::Borrow(bool is_new) {
  {
    const MutexLock lock(mutex_);
    is_returned_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return num_left_ > 0; });
    --num_left_;
    if (!idle_.empty() && !is_new) {
      Connection connection = std::move(idle_.back());
      idle_.pop_back();
      return Lease(*this, std::move(connection));
    }
    if (is_new) idle_.clear();  // they were lost with the last one
  }
  Result<Connection> opened = Connection::Open(options_);
  if (opened.ok()) return Lease(*this, std::move(opened).value());
  const MutexLock lock(mutex_);
  ++num_left_;
  is_returned_.NotifyOne();
  return opened.status();
}

void Pool::Return(Connection connection) {
  const MutexLock lock(mutex_);
  ++num_left_;
  if (connection.IsBroken()) num_trips_of_lost_ += connection.num_round_trips();
  else idle_.push_back(std::move(connection));
  is_returned_.NotifyOne();
}

std::int64_t Pool::num_round_trips() {
  const MutexLock lock(mutex_);
  std::int64_t num = num_trips_of_lost_;
  for (const Connection& connection : idle_) num += connection.num_round_trips();
  return num;
}

}  // namespace dhpmap::postgres
