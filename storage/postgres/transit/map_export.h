// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <string>

#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// Writes a map as it is committed into a new map file at `path`, while commits continue; in little memory. Keeps one
/// state of the database from being vacuumed meanwhile. NOT_FOUND; DATA_LOSS if the map's row or one of a submap is
/// damaged (tiles are not checked); CANCELLED, which breaks the connection. After any error there is no file.
Status WriteMapFileOf(Connection& connection, const std::string& name, const std::string& path,
                      const std::stop_token& stop);

}  // namespace dhpmap::postgres
