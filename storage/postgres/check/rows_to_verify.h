// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/check/verified_rows.h"
#include "storage/postgres/check/history_to_verify.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/reading/named_map.h"

namespace dhpmap::postgres {

/// Reads a map's rows within the caller's transaction. The key of a submap is its id.
class RowsToVerify final : public VerifiedRows {
 public:
  /// Both outlive it.
  RowsToVerify(Connection& connection, const std::string& name) : connection_(connection), name_(name) {}

  Result<MapRow> ReadMapRow() override;
  Result<std::vector<SubmapRow>> ReadSubmapRows(std::vector<SubmapRow>& damaged) override;
  [[nodiscard]] std::int64_t OwnerOfMapTiles() const override;
  Status ForEachTile(std::int64_t owner_key, const VisitTile& visit) override;
  Status ForEachStray(const VisitStray& visit) override;
  VerifiedHistory& History() override { return *history_; }

  /// The head that was read.
  [[nodiscard]] const NamedMap& map() const { return map_; }

 private:
  Connection& connection_;
  const std::string& name_;
  NamedMap map_;
  std::optional<HistoryToVerify> history_;  ///< of that map
};

}  // namespace dhpmap::postgres
