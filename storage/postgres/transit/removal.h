// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include "mapping/base/mutex.h"
#include "storage/postgres/pool.h"

namespace dhpmap::postgres {

/// Removes a map's name and row at once; SweepSome deletes the other rows. NOT_FOUND; NotOwner if the owner's epoch is
/// not `epoch` (nothing: any owner).
Status RemoveMap(Connection& connection, const std::string& name, std::optional<std::int64_t> epoch);

/// Deletes some hundred rows of a removed map or an abandoned import. Returns whether there may be more.
Result<bool> SweepSome(Connection& connection);

/// Sweeps on its own thread whenever there is something to delete. The next process sweeps what is left.
class Sweeper {
 public:
  /// `pool` outlives it.
  explicit Sweeper(Pool& pool);
  ~Sweeper();
  Sweeper(const Sweeper&) = delete;
  Sweeper& operator=(const Sweeper&) = delete;

  void Notify() DHPMAP_EXCLUDES(mutex_);
  /// Returns once everything removed is swept, or sweeping fails.
  void Wait() DHPMAP_EXCLUDES(mutex_);

 private:
  void Loop() DHPMAP_EXCLUDES(mutex_);
  void SweepAll();

  Pool& pool_;
  Mutex mutex_;
  CondVar wake_, is_idle_;
  bool has_work_ DHPMAP_GUARDED_BY(mutex_) = true;  // of an earlier process
  bool is_busy_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // last
};

}  // namespace dhpmap::postgres
