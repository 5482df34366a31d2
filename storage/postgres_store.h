// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "storage/store.h"

namespace dhpmap {

/// This process among those on the same database.
struct FleetOptions {
  std::string address = {};  ///< see Fleet::Announce
  std::string version = {};  ///< of the program
  /// A process that has not beaten for so long is dead to the others, which take its maps over.
  double lease_s = 2;
  bool beats_by_itself = true;                 ///< false: for tests, which call FleetMember::Beat
  std::function<std::int64_t()> time_ns = {};  ///< of leases; empty: std::chrono::steady_clock
  /// At a start on an older schema: waits until every living process has beaten. Empty: for lease_s.
  std::function<void()> await_beats = {};
};

struct PostgresStoreOptions {
  std::string schema = "dhpmap";  ///< of its tables: letters, digits and _
  ChangeHistoryLimits changes = {};
  EditLogLimits edits = {};
  /// Blobs that nobody refers to any more stay so long, by the time that servers have the map open.
  double dead_grace_s = 600;
  int max_connections = 8;  ///< besides one for beats
  /// Voxels of objects stay in the database until they are read, see TilePage.
  bool pages_tiles = false;
  /// For an answer of the database; and, if it was lost, for learning what became of a commit.
  double answer_s = 30;
  /// Where files of maps lie while they are exported or imported; empty: the folder for temporary files.
  std::string transit_folder = {};
  /// Reports the progress of migrations while opening; may be empty.
  std::function<void(const std::string& message)> on_progress = {};
  /// Clock of the ages of kept data, in ns; empty: std::chrono::steady_clock.
  std::function<std::int64_t()> passing_time_ns = {};
  FleetOptions fleet = {};
  /// For tests: SQL of the schema's next steps, as a later version has them.
  std::vector<std::string> later_steps = {};
};

/// Opens or creates a store in a PostgreSQL database (14 or later). `url`: postgresql://..., as libpq takes it; it is
/// in no message. UNAVAILABLE if the database does not answer; FAILED_PRECONDITION, reason NEWER_SCHEMA, or without
/// rights. An older schema is brought up to date if no other process lives on it; else this one works on that of the
/// release before, until Fleet::FinishUpgrade, and FAILED_PRECONDITION if it is older still.
///
/// Any number of processes for each database; MapStore::fleet() tells who owns which map. Who loads or writes a map
/// takes it, if no living process has it: else UNAVAILABLE, reason NOT_OWNER, with the address in the metadata as
/// `owner`. A commit of a map that another process has taken is refused so, too. Closing the store gives all maps up.
/// Both durabilities are full. Backup: NOT_A_FILE.
Result<std::unique_ptr<MapStore>> OpenPostgresStore(const std::string& url, const PostgresStoreOptions& options = {});

/// Whether a database is named by a URL of PostgreSQL, and not as a file.
bool IsPostgresUrl(const std::string& db);

}  // namespace dhpmap
