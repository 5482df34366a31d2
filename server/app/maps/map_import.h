// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "server/app/maps/map_registry.h"

namespace dhpmap {

/// A place among those that may be had at once of something; counts while it lives.
class CountedPlace {
 public:
  /// Null if all `max` are had. `count` outlives the place.
  static std::unique_ptr<CountedPlace> TryTake(std::atomic<int>& count, int max);
  ~CountedPlace() { --count_; }
  CountedPlace(const CountedPlace&) = delete;
  CountedPlace& operator=(const CountedPlace&) = delete;

 private:
  explicit CountedPlace(std::atomic<int>& count) : count_(count) {}
  std::atomic<int>& count_;
};

/// A map that comes in as a file. What is not shown at the end leaves nothing behind. Lives no longer than its
/// registry. Thread-compatible.
class IncomingMap {
 public:
  /// Of MapRegistry::BeginImport.
  IncomingMap(MapRegistry& registry, ImportRequest request, std::int64_t max_bytes, std::unique_ptr<CountedPlace> place,
              std::unique_ptr<MapImport> import);

  /// The next part of the file. RESOURCE_EXHAUSTED, reason BODY_TOO_LARGE if it is larger than may be, or the disk is
  /// full; INVALID_ARGUMENT, BAD_MAP, if it is larger than was announced.
  Status Write(std::string_view piece);
  /// After the last part: looks through it and brings most of it into the store, which takes as long as reading and
  /// writing it. Errors of MapImport; ALREADY_EXISTS; INVALID_ARGUMENT, BAD_MAP, for less than was announced.
  Status Prepare(const std::stop_token& stop);
  /// After that; blocks for some milliseconds. Then the map is there for all.
  Result<MapSummary> Show();

 private:
  MapRegistry& registry_;
  const ImportRequest request_;
  const std::int64_t max_bytes_;
  const std::unique_ptr<CountedPlace> place_;  // until all else is gone
  std::unique_ptr<MapImport> import_;
  std::int64_t num_bytes_ = 0;
  std::string name_;
  std::optional<HeldName> held_;
};

}  // namespace dhpmap
