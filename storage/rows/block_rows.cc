// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/block_rows.h"

#include <string>
#include <utility>

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

std::string Table(Layer layer) { return std::string(LayerName(layer)) + "_blocks"; }

}  // namespace

std::string_view LayerName(Layer layer) {
  switch (layer) {
    case Layer::kTsdf: return "tsdf";
    case Layer::kLabels: return "label";
    case Layer::kGone: return "gone";
  }
  return {};
}

std::string BlockName(std::uint32_t submap_id, Layer layer, BlockIndex index) {
  return "submap " + std::to_string(submap_id) + ": " + std::string(LayerName(layer)) + " block (" +
         std::to_string(index.x) + ", " + std::to_string(index.y) + ", " + std::to_string(index.z) + ")";
}

BlockRowWriter::BlockRowWriter(Statement find, Statement insert, Statement update, Statement erase)
    : find_(std::move(find)), insert_(std::move(insert)), update_(std::move(update)), erase_(std::move(erase)) {}

Result<BlockRowWriter> BlockRowWriter::Prepare(Database& database, Layer layer) {
  constexpr char kTask[] = "write a block";
  const std::string table = Table(layer);
  DHPMAP_ASSIGN_OR_RETURN(Statement find, database.Prepare("SELECT block_key, length(blob) FROM " + table +
                                                               " WHERE submap_key = ? AND x = ? AND y = ? AND z = ?",
                                                           kTask));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement insert,
      database.Prepare("INSERT INTO " + table + " (submap_key, x, y, z, blob) VALUES (?, ?, ?, ?, ?)", kTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement update,
                          database.Prepare("UPDATE " + table + " SET blob = ? WHERE block_key = ?", kTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase,
                          database.Prepare("DELETE FROM " + table + " WHERE block_key = ?", "delete a block"));
  return BlockRowWriter(std::move(find), std::move(insert), std::move(update), std::move(erase));
}

Result<BlockRowWriter::Stored> BlockRowWriter::Find(std::int64_t submap_key, BlockIndex index) {
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, find_.Bind(submap_key).Bind(index.x).Bind(index.y).Bind(index.z).Step());
  if (!has_row) return Stored{};
  sqlite::Columns columns(find_);
  Stored stored;
  stored.key = columns.Int();
  stored.bytes = columns.Int();
  find_.Reset();
  return stored;
}

Result<BlockDelta> BlockRowWriter::Write(std::int64_t submap_key, BlockIndex index, ByteView blob, bool is_new) {
  const auto bytes = static_cast<std::int64_t>(blob.size());
  Stored stored;
  if (!is_new) {
    DHPMAP_ASSIGN_OR_RETURN(stored, Find(submap_key, index));
  }
  if (stored.key != 0) {
    DHPMAP_RETURN_IF_ERROR(update_.Bind(blob).Bind(stored.key).Run());
    return BlockDelta{0, bytes - stored.bytes};
  }
  DHPMAP_RETURN_IF_ERROR(insert_.Bind(submap_key).Bind(index.x).Bind(index.y).Bind(index.z).Bind(blob).Run());
  return BlockDelta{1, bytes};
}

Result<BlockDelta> BlockRowWriter::Erase(std::int64_t submap_key, BlockIndex index) {
  DHPMAP_ASSIGN_OR_RETURN(const Stored stored, Find(submap_key, index));
  if (stored.key == 0) return BlockDelta{};
  DHPMAP_RETURN_IF_ERROR(erase_.Bind(stored.key).Run());
  return BlockDelta{-1, -stored.bytes};
}

Result<BlockRowReader> BlockRowReader::Prepare(Database& database, Layer layer) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare("SELECT x, y, z, blob FROM " + Table(layer) +
                                                                 " WHERE submap_key = ? ORDER BY x, y, z",
                                                             "read the blocks"));
  return BlockRowReader(std::move(select));
}

}  // namespace dhpmap
