// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "storage/postgres/answer.h"
#include "storage/rows/tile_rows.h"

namespace dhpmap::postgres {

/// Select tiles with their blobs: all of map $1 by owner, or those of its owner $2.
const std::string& AllTilesText();
const std::string& TilesOfOwnerText();
/// Reads the columns of a row after the first one, the owner.
TileRow TileOf(Answer& answer);

}  // namespace dhpmap::postgres
