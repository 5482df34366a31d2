// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "storage/codec/bytes.h"
#include "storage/rows/kept_blobs.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// Blobs that are written before the rows that refer to them, in earlier transactions. Until then they are listed as
// dead: the importing process protects them (KeptBlobs), and if it ends first they are collected.

/// Reserves that many keys.
Result<BlobRange> ReserveBlobKeys(sqlite::Database& database, std::int64_t num_blobs);

/// Writes blobs under reserved keys. One for each transaction.
class BroughtBlobs {
 public:
  static Result<BroughtBlobs> Prepare(sqlite::Database& database);
  Status Insert(std::int64_t blob_key, std::int64_t num_blocks, ByteView blob);

 private:
  BroughtBlobs(sqlite::Statement blob, sqlite::Statement dead) : blob_(std::move(blob)), dead_(std::move(dead)) {}
  sqlite::Statement blob_, dead_;
};

/// For a transaction with rows that refer to all of them.
Status ReviveBlobs(sqlite::Database& database, BlobRange range);

}  // namespace dhpmap
