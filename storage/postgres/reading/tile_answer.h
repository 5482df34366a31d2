// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "storage/postgres/answer.h"
#include "storage/rows/tile_rows.h"

namespace dhpmap::postgres {

/// SELECTs of tiles with their blobs: all of a map ($1) by owner, and those of owner $2.
const std::string& AllTilesText();
const std::string& TilesOfOwnerText();
/// The rest of a row, after its first column: the owner.
TileRow TileOf(Answer& answer);

}  // namespace dhpmap::postgres
