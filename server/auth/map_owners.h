// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "mapping/base/result.h"

namespace dhpmap::auth {

/// Records which principal created which map, by the map's history id, to enforce the limit of maps. Maps that are not
/// listed have no owner, as those made without keys. Thread-safe.
class MapOwners {
 public:
  virtual ~MapOwners() = default;

  /// UNAVAILABLE if the entry cannot be stored.
  virtual Status Add(std::uint64_t history_id, const std::string& principal) = 0;
  [[nodiscard]] virtual Result<std::optional<std::string>> OwnerOf(std::uint64_t history_id) const = 0;
  /// Maps that one principal has made, perhaps with some that are gone.
  [[nodiscard]] virtual Result<std::set<std::uint64_t>> MapsOf(const std::string& principal) const = 0;

  /// Entries that stay until Keep forgets them, gone maps among them; 0 if they go by themselves.
  [[nodiscard]] virtual std::size_t size() const = 0;
  /// Forgets all other maps.
  virtual Status Keep(const std::set<std::uint64_t>& history_ids) = 0;
};

}  // namespace dhpmap::auth
