// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// One map as a file: a database of the present schema with only that map, so that later versions read it like any older
// database.

/// A new file with the tables of the present schema, and no map yet; to be removed unless all of it gets written.
Result<sqlite::Database> MakeMapFile(const std::string& path);

/// Writes one map of the database at `source_path` to a new file, as committed, while commits continue. NOT_FOUND;
/// DATA_LOSS if the map's row is damaged (tiles are not checked); CANCELLED. After any error there is no file at
/// `path`.
Status WriteMapFile(const std::string& source_path, const std::string& name, const std::string& path,
                    const std::stop_token& stop);

/// Opens such a file, which is untrusted and may be modified; migrates it and verifies all of it, in little memory.
/// INVALID_ARGUMENT, reason BAD_MAP, if it is another kind of file, does not hold exactly one map, or holds one that no
/// server writes (imported_map.h); DATA_LOSS, DAMAGED_MAP; FAILED_PRECONDITION, NEWER_SCHEMA, NEWER_CONFIG or
/// NEWER_LAYER; CANCELLED.
class MapFile {
 public:
  static Result<MapFile> Open(const std::string& path, const std::stop_token& stop);

  [[nodiscard]] const std::string& map_name() const { return name_; }
  /// It has no other writer.
  [[nodiscard]] sqlite::Database& database() { return file_; }

 private:
  MapFile(sqlite::Database file, std::string name) : file_(std::move(file)), name_(std::move(name)) {}
  sqlite::Database file_;
  std::string name_;
};

/// The error of cancelled work on such a file: CANCELLED.
Status NobodyWaits();

/// Removes a database file together with SQLite's files for it.
void RemoveDatabase(const std::string& path);

}  // namespace dhpmap
