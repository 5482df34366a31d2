// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "storage/check/verified_history.h"
#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// Reads a map's histories within the caller's transaction. The key of an edit is its revision.
class HistoryToVerify final : public VerifiedHistory {
 public:
  /// `connection` outlives it.
  HistoryToVerify(Connection& connection, std::int64_t map_key) : connection_(connection), map_key_(map_key) {}

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
  Result<EditTotals> TotalsBy(const std::string& text);

  Connection& connection_;
  const std::int64_t map_key_;
};

}  // namespace dhpmap::postgres
