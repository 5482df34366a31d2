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

/// Which principal has made which map, by the map's history id, so that one who makes too many can be told so. A file
/// of a line of JSON a map, of mode 0600, beside the database and no part of it: a backup and an exported map say
/// nothing of keys. A map that is not in it is nobody's, as those are that were made without keys. Thread-safe.
class MapOwners {
 public:
  /// Reads it if it is there; lines that are none of ours are left out. FAILED_PRECONDITION, reason BAD_KEY_FILE, for a
  /// link, or a file that cannot be read and written. An empty path: nothing is kept.
  static Result<std::unique_ptr<MapOwners>> Open(const std::string& path);
  ~MapOwners();
  MapOwners(const MapOwners&) = delete;
  MapOwners& operator=(const MapOwners&) = delete;

  /// UNAVAILABLE, reason NOT_STORED, if that could not be written; it counts all the same, until the next start.
  Status Add(std::uint64_t history_id, const std::string& principal) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::optional<std::string> OwnerOf(std::uint64_t history_id) const DHPMAP_EXCLUDES(mutex_);
  /// Forgets all other maps, here and in the file, which is written anew and renamed. Errors as of Add.
  Status Keep(const std::set<std::uint64_t>& history_ids) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t size() const DHPMAP_EXCLUDES(mutex_);

 private:
  MapOwners(std::string path, int file, std::map<std::uint64_t, std::string> owners)
      : path_(std::move(path)), file_(file), owners_(std::move(owners)) {}

  const std::string path_;  ///< empty: none
  mutable Mutex mutex_;
  int file_ DHPMAP_GUARDED_BY(mutex_);  ///< below 0: none
  std::map<std::uint64_t, std::string> owners_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth
