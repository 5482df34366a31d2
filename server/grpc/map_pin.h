// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "mapping/base/result.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// Holds one state of one map for some seconds at most, then lets go of it by itself. Thread-compatible.
class MapPin {
 public:
  explicit MapPin(std::chrono::milliseconds longest = std::chrono::seconds(10));
  ~MapPin();
  MapPin(const MapPin&) = delete;
  MapPin& operator=(const MapPin&) = delete;

  /// In place of whatever is held.
  void Hold(std::string map, std::shared_ptr<const MapView> view);
  void Release();

  /// The state that is held of a map; null if none is. FAILED_PRECONDITION if it was let go because its time was over.
  [[nodiscard]] Result<std::shared_ptr<const MapView>> Of(const std::string& map) const;

 private:
  struct Held;

  const std::chrono::milliseconds longest_;
  std::shared_ptr<Held> held_;  ///< shared with its alarm; null: nothing
};

}  // namespace dhpmap
