// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "storage/codec/bytes.h"
#include "storage/rows/kept_blobs.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// Blobs that come before the rows that refer to them, in transactions of their own. Until then they are among the dead:
// whoever brings them keeps them (KeptBlobs), and if the process ends first they are collected.

/// Keys for so many blobs, which nobody else is given.
Result<BlobRange> ReserveBlobKeys(sqlite::Database& database, std::int64_t num_blobs);

/// Writes blobs under such keys. One for each transaction.
class BroughtBlobs {
 public:
  static Result<BroughtBlobs> Prepare(sqlite::Database& database);
  Status Insert(std::int64_t blob_key, std::int64_t num_blocks, ByteView blob);

 private:
  BroughtBlobs(sqlite::Statement blob, sqlite::Statement dead) : blob_(std::move(blob)), dead_(std::move(dead)) {}
  sqlite::Statement blob_, dead_;
};

/// Rows of this transaction refer to all of them.
Status ReviveBlobs(sqlite::Database& database, BlobRange range);

}  // namespace dhpmap
