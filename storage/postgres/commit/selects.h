// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace dhpmap::postgres {

// What a commit fetches before it writes: SELECTs by map_key ($1).

/// SELECT of the columns that TileWrites::Fetched reads: of tiles named by four arrays ($2 to $5), and of all tiles of
/// owners ($2).
const std::string& TilesByPlace();
const std::string& TilesByOwner();
/// Of submaps by id ($2), and of blobs by key ($2).
const std::string& SubmapsById();
const std::string& BlobsByKey();

}  // namespace dhpmap::postgres
