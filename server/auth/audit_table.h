// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"
#include "server/auth/audit_entry.h"
#include "server/auth/keys/utc_text.h"
#include "storage/auth_tables.h"

namespace dhpmap::auth {

struct AuditTableOptions {
  std::int64_t server = 0;  ///< FleetServer::id
  double flush_s = 1;       ///< longest time that a row waits in memory; 0: until Flush is called
  WallClock now_s = SystemWallClock();
  /// Called with the reason when rows cannot be stored or are dropped, once for each outage. For the log.
  std::function<void(const Status&)> on_fault = {};
};

/// Records admitted calls that change something, and refused calls, in the database that several servers share. Rows
/// wait in memory, and a thread stores them; RefusalLimit holds. While the database does not answer, kMostWaiting rows
/// wait, and later ones are dropped and counted. The next row states how many are missing. Thread-safe.
class AuditTable {
 public:
  static constexpr std::size_t kMostWaiting = 10'000, kMostOfABatch = 500;

  AuditTable(std::shared_ptr<AuthTables> tables, AuditTableOptions options);
  /// Stores what waits, if the database answers.
  ~AuditTable();
  AuditTable(const AuditTable&) = delete;
  AuditTable& operator=(const AuditTable&) = delete;

  /// Never waits for the database.
  void Write(const AuditEntry& entry) DHPMAP_EXCLUDES(mutex_);
  /// Stores the rows that wait. UNAVAILABLE or RESOURCE_EXHAUSTED: they go on waiting. Other errors: the database
  /// refuses these rows, and they are dropped.
  Status Flush() DHPMAP_EXCLUDES(flush_mutex_, mutex_);
  /// Since the start, without refusals beyond RefusalLimit.
  [[nodiscard]] std::int64_t num_dropped() const DHPMAP_EXCLUDES(mutex_);

 private:
  void Loop() DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::vector<AuditRow> NextBatch() const DHPMAP_EXCLUDES(mutex_);
  void Remove(std::size_t num_rows, bool are_stored) DHPMAP_EXCLUDES(mutex_);
  void Drop(std::size_t num_rows) DHPMAP_REQUIRES(mutex_);
  void Tell(const Status& fault) DHPMAP_EXCLUDES(mutex_);

  const std::shared_ptr<AuthTables> tables_;
  const AuditTableOptions options_;
  Mutex flush_mutex_;  // taken before the other
  mutable Mutex mutex_;
  CondVar wake_;
  std::deque<AuditRow> waiting_ DHPMAP_GUARDED_BY(mutex_);
  RefusalLimit refusals_ DHPMAP_GUARDED_BY(mutex_);
  std::int64_t next_number_ DHPMAP_GUARDED_BY(mutex_) = 1;
  std::int64_t num_missing_ DHPMAP_GUARDED_BY(mutex_) = 0;  ///< dropped, and not stated in a row yet
  std::int64_t num_dropped_ DHPMAP_GUARDED_BY(mutex_) = 0;
  bool is_faulty_ DHPMAP_GUARDED_BY(mutex_) = false;  ///< on_fault was called, and no row was stored since
  bool is_ending_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread writer_;
};

}  // namespace dhpmap::auth
