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
#include "server/auth/map_owners.h"

namespace dhpmap::auth {

/// The owners of the maps of one server. The file has one line of JSON a map and mode 0600. It is separate from the
/// database, so backups and exported maps do not reveal principals.
class MapOwnersFile final : public MapOwners {
 public:
  /// Reads the file if it exists, and ignores malformed lines. FAILED_PRECONDITION, reason BAD_KEY_FILE, for a link, or
  /// a file that cannot be read and written. With an empty path nothing is stored.
  static Result<std::unique_ptr<MapOwnersFile>> Open(const std::string& path);
  ~MapOwnersFile() override;
  MapOwnersFile(const MapOwnersFile&) = delete;
  MapOwnersFile& operator=(const MapOwnersFile&) = delete;

  /// UNAVAILABLE, reason NOT_STORED, if the file cannot be written; the entry still counts until the next start.
  Status Add(std::uint64_t history_id, const std::string& principal) override DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] Result<std::optional<std::string>> OwnerOf(std::uint64_t history_id) const override
      DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] Result<std::set<std::uint64_t>> MapsOf(const std::string& principal) const override
      DHPMAP_EXCLUDES(mutex_);
  /// Rewrites and renames the file. Errors as in Add.
  Status Keep(const std::set<std::uint64_t>& history_ids) override DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t size() const override DHPMAP_EXCLUDES(mutex_);

 private:
  MapOwnersFile(std::string path, int file, std::map<std::uint64_t, std::string> owners)
      : path_(std::move(path)), file_(file), owners_(std::move(owners)) {}

  const std::string path_;  ///< empty: no file
  mutable Mutex mutex_;
  int file_ DHPMAP_GUARDED_BY(mutex_);  ///< below 0: no file
  std::map<std::uint64_t, std::string> owners_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth
