// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/check/sqlite_history.h"
#include "storage/check/verified_rows.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// A map's rows in a SQLite database, within the caller's transaction.
class SqliteRows final : public VerifiedRows {
 public:
  /// Both outlive it.
  SqliteRows(sqlite::Database& database, const std::string& name) : database_(database), name_(name) {}

  Result<MapRow> ReadMapRow() override;
  Result<std::vector<SubmapRow>> ReadSubmapRows(std::vector<SubmapRow>& damaged) override;
  [[nodiscard]] std::int64_t OwnerOfMapTiles() const override;
  Status ForEachTile(std::int64_t owner_key, const VisitTile& visit) override;
  Result<std::string> ProblemOfBounds(const SubmapRow& submap) override;
  Status ForEachStray(const VisitStray& visit) override;
  VerifiedHistory& History() override { return *history_; }

 private:
  Status ForEachOrphan(const VisitStray& visit);

  sqlite::Database& database_;
  const std::string& name_;
  std::int64_t map_key_ = 0;
  std::optional<SqliteHistory> history_;  ///< of that map
};

}  // namespace dhpmap
