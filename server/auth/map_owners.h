// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"

namespace dhpmap::auth {

/// Records which principal created which map, by the map's history id, to enforce the limit of maps. The file has one
/// line of JSON a map and mode 0600. It is separate from the database, so backups and exported maps do not reveal
/// principals. Maps that are not listed have no owner, as those made without keys. Thread-safe.
class MapOwners {
 public:
  /// Reads the file if it exists, and ignores malformed lines. FAILED_PRECONDITION, reason BAD_KEY_FILE, for a link, or
  /// a file that cannot be read and written. With an empty path nothing is stored.
  static Result<std::unique_ptr<MapOwners>> Open(const std::string& path);
  ~MapOwners();
  MapOwners(const MapOwners&) = delete;
  MapOwners& operator=(const MapOwners&) = delete;

  /// UNAVAILABLE, reason NOT_STORED, if the file cannot be written; the entry still counts until the next start.
  Status Add(std::uint64_t history_id, const std::string& principal) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::optional<std::string> OwnerOf(std::uint64_t history_id) const DHPMAP_EXCLUDES(mutex_);
  /// Forgets all other maps, also in the file, which is rewritten and renamed. Errors as in Add.
  Status Keep(const std::set<std::uint64_t>& history_ids) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t size() const DHPMAP_EXCLUDES(mutex_);
  /// How many of them one principal has made; maps that are gone count until they are forgotten.
  [[nodiscard]] std::size_t NumOf(const std::string& principal) const DHPMAP_EXCLUDES(mutex_);

 private:
  MapOwners(std::string path, int file, std::map<std::uint64_t, std::string> owners)
      : path_(std::move(path)), file_(file), owners_(std::move(owners)) {}

  const std::string path_;  ///< empty: no file
  mutable Mutex mutex_;
  int file_ DHPMAP_GUARDED_BY(mutex_);  ///< below 0: no file
  std::map<std::uint64_t, std::string> owners_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth
