// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "storage/check/verified_history.h"
#include "storage/check/verify_history.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// A map's histories in a SQLite database, within the caller's transaction.
class SqliteHistory final : public VerifiedHistory {
 public:
  /// `database` outlives it.
  SqliteHistory(sqlite::Database& database, std::int64_t map_key) : database_(database), map_key_(map_key) {}

  Result<std::optional<ChangeLogRow>> ReadChangeLog() override;
  Status ForEachChange(const VisitChange& visit) override;
  Status ForEachEdit(const VisitEdit& visit) override;
  Result<bool> LacksTarget(std::int64_t target, const EditRow& edit) override;
  Status ForEachHistory(const VisitHistory& visit) override;
  Status ForEachEditTile(const EditHistoryRow& history, const VisitEditTile& visit) override;
  Status ForEachLostTarget(const VisitTarget& visit) override;
  Result<EditTotals> CountEdits() override;
  Result<EditTotals> NotedEdits() override;

 private:
  sqlite::Database& database_;
  const std::int64_t map_key_;
};

/// Within the caller's transaction: drops bad parts of the log and recounts the rest. If the state was changed other
/// than by edits (`is_state_changed`), all undo data are dropped; log and answers to repeated requests stay.
Status RepairHistory(sqlite::Database& database, std::int64_t map_key, const BadHistory& bad, bool is_state_changed);

}  // namespace dhpmap
