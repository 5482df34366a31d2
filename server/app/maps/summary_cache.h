// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

#include "mapping/map/lost_revisions.h"
#include "server/app/maps/map_summary.h"

namespace dhpmap {

/// The store's data of a map.
struct MapInStore {
  MapSummary summary;
  std::shared_ptr<const LostRevisions> lost_revisions;  ///< not null
};

/// The store's last answers about closed maps; keeps the most recently used. An answer is added only if no map has
/// changed since the request: call number() before it. Thread-compatible.
class SummaryCache {
 public:
  /// 0: caches nothing.
  explicit SummaryCache(std::size_t max_maps) : max_maps_(max_maps) {}

  /// Null: ask the store. Valid until the next call of another function.
  [[nodiscard]] const MapInStore* Find(const std::string& name) {
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) return nullptr;
    maps_.splice(maps_.begin(), maps_, found->second);
    return &found->second->second;
  }
  /// Number of changes so far.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// `number`: from before the request to the store.
  void Add(const std::string& name, MapInStore map, std::uint64_t number) {
    if (max_maps_ == 0 || number != number_ || by_name_.contains(name)) return;
    maps_.emplace_front(name, std::move(map));
    by_name_[name] = maps_.begin();
    if (maps_.size() <= max_maps_) return;
    by_name_.erase(maps_.back().first);
    maps_.pop_back();
  }
  /// Call it when the map changes or is opened.
  void Forget(const std::string& name) {
    ++number_;
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) return;
    maps_.erase(found->second);
    by_name_.erase(found);
  }

 private:
  using Maps = std::list<std::pair<std::string, MapInStore>>;
  const std::size_t max_maps_;
  std::uint64_t number_ = 0;
  Maps maps_;  ///< most recently used first
  std::unordered_map<std::string, Maps::iterator> by_name_;
};

}  // namespace dhpmap
