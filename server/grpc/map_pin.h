// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "mapping/base/result.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// Pins one state of one map for a few seconds, then releases it by itself. Thread-compatible.
class MapPin {
 public:
  explicit MapPin(std::chrono::milliseconds longest = std::chrono::seconds(10));
  ~MapPin();
  MapPin(const MapPin&) = delete;
  MapPin& operator=(const MapPin&) = delete;

  /// Replaces the pinned state, if any.
  void Hold(std::string map, std::shared_ptr<const MapView> view);
  void Release();

  /// The pinned state of that map; null if there is none. FAILED_PRECONDITION if its time ran out.
  [[nodiscard]] Result<std::shared_ptr<const MapView>> Of(const std::string& map) const;

 private:
  struct Held;

  const std::chrono::milliseconds longest_;
  std::shared_ptr<Held> held_;  ///< shared with its alarm; null: no state is pinned
};

}  // namespace dhpmap
