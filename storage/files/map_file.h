// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// One map as a file of its own: a database of the present schema with nothing else in it, so that a later version reads
// it as it reads any older database.

/// Writes one map of the database at `source_path` to a new file, as committed, while commits go on. NOT_FOUND;
/// DATA_LOSS if the map's row is damaged (tiles are not looked at); CANCELLED. On error nothing is left at `path`.
Status WriteMapFile(const std::string& source_path, const std::string& name, const std::string& path,
                    const std::stop_token& stop);

/// Opens such a file, which may be anything, and may be written; brings it up to date and looks through all of it, with
/// little memory. INVALID_ARGUMENT, reason BAD_MAP, if it is another file, holds other than one map, or one that no
/// server makes (imported_map.h); DATA_LOSS, DAMAGED_MAP; FAILED_PRECONDITION, NEWER_SCHEMA, NEWER_CONFIG or
/// NEWER_LAYER; CANCELLED.
class MapFile {
 public:
  static Result<MapFile> Open(const std::string& path, const std::stop_token& stop);

  [[nodiscard]] const std::string& map_name() const { return name_; }
  /// Which nobody else writes.
  [[nodiscard]] sqlite::Database& database() { return file_; }

 private:
  MapFile(sqlite::Database file, std::string name) : file_(std::move(file)), name_(std::move(name)) {}
  sqlite::Database file_;
  std::string name_;
};

/// What work on such a file ends with once it is asked to stop: CANCELLED.
Status NobodyWaits();

/// Removes a file that is a database, and what SQLite keeps beside it.
void RemoveDatabase(const std::string& path);

}  // namespace dhpmap
