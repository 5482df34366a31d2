// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <string>

#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// Writes the committed state of a map into a new map file at `path`, in little memory, while commits continue. Keeps
/// one state of the database from being vacuumed meanwhile. NOT_FOUND; DATA_LOSS if the row of the map or of a submap
/// is damaged (tiles are not checked); CANCELLED, which breaks the connection. After an error there is no file.
Status WriteMapFileOf(Connection& connection, const std::string& name, const std::string& path,
                      const std::stop_token& stop);

}  // namespace dhpmap::postgres
