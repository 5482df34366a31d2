// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "storage/history/edit_tiles.h"
#include "storage/rows/change_rows.h"
#include "storage/rows/edit_rows.h"

namespace dhpmap {

/// Number and bytes of a map's edits, and of what undoes them, as table edit_totals has them.
using EditTotals = std::array<std::int64_t, 4>;

/// A row of edit_tiles, with its blobs.
struct EditTileToVerify {
  EditTileRow row;
  bool lacks_before = false, lacks_after = false;  ///< there is no blob of its key
};

/// What a verification reads of a map's histories, all of one state. Rows come as they are stored; `is_read` is false
/// for one with a value of a wrong type. Visitors of edits and histories may ask further questions meanwhile. Errors
/// are those of the store, and of visitors.
class VerifiedHistory {
 public:
  using VisitChange = std::function<Status(const ChangeRow& row, bool is_read)>;
  using VisitEdit = std::function<Status(const EditRow& row, bool is_read)>;
  using VisitHistory = std::function<Status(const EditHistoryRow& row, bool is_read, std::int64_t revision)>;
  using VisitEditTile = std::function<Status(const EditTileToVerify& tile)>;
  using VisitTarget = std::function<Status(std::int64_t target, std::int64_t revision)>;

  virtual ~VerifiedHistory() = default;
  /// DATA_LOSS if its row is damaged.
  virtual Result<std::optional<ChangeLogRow>> ReadChangeLog() = 0;
  /// By revision.
  virtual Status ForEachChange(const VisitChange& visit) = 0;
  /// By revision.
  virtual Status ForEachEdit(const VisitEdit& visit) = 0;
  /// Whether the log has edit `target`, and does not say that `edit` has undone it or done it again.
  virtual Result<bool> LacksTarget(std::int64_t target, const EditRow& edit) = 0;
  /// With the revision of the edit that has the row's key; 0: there is none.
  virtual Status ForEachHistory(const VisitHistory& visit) = 0;
  /// By object, tile and layer.
  virtual Status ForEachEditTile(const EditHistoryRow& history, const VisitEditTile& visit) = 0;
  /// What edits are said to have undone, or done again, that the log does not have.
  virtual Status ForEachLostTarget(const VisitTarget& visit) = 0;
  virtual Result<EditTotals> CountEdits() = 0;
  /// Zeros if they are not noted.
  virtual Result<EditTotals> NotedEdits() = 0;
};

}  // namespace dhpmap
