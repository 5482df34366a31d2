// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/brought_blobs.h"

#include <utility>

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kBringTask[] = "bring the map's tiles";

}  // namespace

Result<BlobRange> ReserveBlobKeys(Database& database, std::int64_t num_blobs) {
  // Inserts the row if the table has never had one.
  DHPMAP_RETURN_IF_ERROR(
      database.Execute("INSERT INTO sqlite_sequence (name, seq) SELECT 'tile_blobs', 0 WHERE NOT EXISTS (SELECT 1 FROM "
                       "sqlite_sequence WHERE name = 'tile_blobs')",
                       kBringTask));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t last,
                          database.QueryInt("SELECT seq FROM sqlite_sequence WHERE name = 'tile_blobs'", kBringTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement raise,
                          database.Prepare("UPDATE sqlite_sequence SET seq = ? WHERE name = 'tile_blobs'", kBringTask));
  DHPMAP_RETURN_IF_ERROR(raise.Bind(last + num_blobs).Run());
  return BlobRange{last + 1, last + num_blobs};
}

Result<BroughtBlobs> BroughtBlobs::Prepare(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement blob,
      database.Prepare("INSERT INTO tile_blobs (blob_key, num_blocks, blob) VALUES (?, ?, ?)", kBringTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement dead, database.Prepare("INSERT INTO dead_blobs (blob_key) VALUES (?)", kBringTask));
  return BroughtBlobs(std::move(blob), std::move(dead));
}

Status BroughtBlobs::Insert(std::int64_t blob_key, std::int64_t num_blocks, ByteView blob) {
  DHPMAP_RETURN_IF_ERROR(blob_.Bind(blob_key).Bind(num_blocks).Bind(blob).Run());
  return dead_.Bind(blob_key).Run();
}

Status ReviveBlobs(Database& database, BlobRange range) {
  DHPMAP_ASSIGN_OR_RETURN(Statement revive,
                          database.Prepare("DELETE FROM dead_blobs WHERE blob_key BETWEEN ? AND ?", kBringTask));
  return revive.Bind(range.first).Bind(range.last).Run();
}

}  // namespace dhpmap
