// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace dhpmap::postgres {

// The SELECTs by map_key ($1) that a commit runs before it writes.

/// Select the columns that TileWrites::Fetched reads: for tiles named by four arrays ($2 to $5), or for all tiles of
/// the owners in $2.
const std::string& TilesByPlace();
const std::string& TilesByOwner();
/// Select submaps by id ($2), and blobs by key ($2).
const std::string& SubmapsById();
const std::string& BlobsByKey();

}  // namespace dhpmap::postgres
