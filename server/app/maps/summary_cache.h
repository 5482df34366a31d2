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

/// What a store says of a map.
struct MapInStore {
  MapSummary summary;
  std::shared_ptr<const LostRevisions> lost_revisions;  ///< not null
};

/// What the store has said of closed maps, the last used ones. An answer is added only if no map has changed since it
/// was asked for: take number() before. Thread-compatible.
class SummaryCache {
 public:
  /// 0: keeps nothing.
  explicit SummaryCache(std::size_t max_maps) : max_maps_(max_maps) {}

  /// Null: ask the store. Valid until the next call of another function.
  [[nodiscard]] const MapInStore* Find(const std::string& name) {
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) return nullptr;
    maps_.splice(maps_.begin(), maps_, found->second);
    return &found->second->second;
  }
  /// Of changes.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// `number`: from before the store was asked.
  void Add(const std::string& name, MapInStore map, std::uint64_t number) {
    if (max_maps_ == 0 || number != number_ || by_name_.contains(name)) return;
    maps_.emplace_front(name, std::move(map));
    by_name_[name] = maps_.begin();
    if (maps_.size() <= max_maps_) return;
    by_name_.erase(maps_.back().first);
    maps_.pop_back();
  }
  /// The map changes, or is no longer closed.
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
  Maps maps_;  ///< the last used first
  std::unordered_map<std::string, Maps::iterator> by_name_;
};

}  // namespace dhpmap
