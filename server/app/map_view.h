// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "mapping/map/map.h"
#include "mapping/query/point_lookup.h"

namespace dhpmap {

/// A published state of a map with its index for point queries. Holding it keeps that state alive. Thread-safe.
class MapView {
 public:
  explicit MapView(std::shared_ptr<const MapSnapshot> snapshot) : snapshot_(std::move(snapshot)) {}

  [[nodiscard]] const MapSnapshot& snapshot() const { return *snapshot_; }
  [[nodiscard]] const std::shared_ptr<const MapSnapshot>& shared_snapshot() const { return snapshot_; }

  /// Built by the first caller; others that come meanwhile wait for it.
  [[nodiscard]] const PointLookup& lookup() const {
    std::call_once(lookup_built_, [this] { lookup_.emplace(snapshot_); });
    return *lookup_;
  }

 private:
  std::shared_ptr<const MapSnapshot> snapshot_;
  mutable std::once_flag lookup_built_;
  mutable std::optional<PointLookup> lookup_;
};

}  // namespace dhpmap
