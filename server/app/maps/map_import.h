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

/// One of a limited number of places; held during its lifetime.
class CountedPlace {
 public:
  /// Null if all `max` places are taken. `count` outlives the place.
  static std::unique_ptr<CountedPlace> TryTake(std::atomic<int>& count, int max);
  ~CountedPlace() { --count_; }
  CountedPlace(const CountedPlace&) = delete;
  CountedPlace& operator=(const CountedPlace&) = delete;

 private:
  explicit CountedPlace(std::atomic<int>& count) : count_(count) {}
  std::atomic<int>& count_;
};

/// A map being imported from a file. Discarded unless Show succeeds. Must not outlive its registry. Thread-compatible.
class IncomingMap {
 public:
  /// Created by MapRegistry::BeginImport.
  IncomingMap(MapRegistry& registry, ImportRequest request, std::int64_t max_bytes, std::unique_ptr<CountedPlace> place,
              std::unique_ptr<MapImport> import);

  /// The next part of the file. RESOURCE_EXHAUSTED, reason BODY_TOO_LARGE if it exceeds the limit, or the disk is full;
  /// INVALID_ARGUMENT, BAD_MAP, if it exceeds the announced size.
  Status Write(std::string_view piece);
  /// After the last part: verifies the file and copies most of it into the store, in about the time of reading and
  /// writing it. Errors of MapImport; ALREADY_EXISTS; INVALID_ARGUMENT, BAD_MAP, if it is shorter than announced.
  Status Prepare(const std::stop_token& stop);
  /// Then makes the map visible; blocks for some milliseconds.
  Result<MapSummary> Show();

 private:
  MapRegistry& registry_;
  const ImportRequest request_;
  const std::int64_t max_bytes_;
  const std::unique_ptr<CountedPlace> place_;  // released last
  std::unique_ptr<MapImport> import_;
  std::int64_t num_bytes_ = 0;
  std::string name_;
  std::optional<HeldName> held_;
};

}  // namespace dhpmap
