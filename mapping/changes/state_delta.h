// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

// The difference between two states of a map, with both sides, so that either can be made from the other. Without free
// space, which edits do not change.

/// A tile of a submap: for each side the layers that differ; null: none of them.
struct TileDelta {
  TileIndex index;
  BlockLayers differs{};
  std::shared_ptr<const BlockTile> before, after;
};

/// All of a submap except its blocks.
struct SubmapRowState {
  SubmapInfo info;
  BoundingSphere sphere;
};

struct SubmapDelta {
  SubmapId id;
  std::optional<SubmapRowState> before, after;  ///< nothing: it did not exist
  std::vector<TileDelta> tiles;
};

/// A tile of the vacated space; null: it did not exist.
struct VacatedDelta {
  TileIndex index;
  std::shared_ptr<const FreeTile> before, after;
};

/// For lists: the entries that the other side lacks or has with another value.
template <typename Entry>
struct ListDelta {
  std::vector<Entry> before, after;
  [[nodiscard]] bool empty() const { return before.empty() && after.empty(); }
};

struct StateDelta {
  std::vector<SubmapDelta> submaps;  ///< by ascending id
  std::vector<VacatedDelta> vacated;
  ListDelta<ObjectPair> pairs;
  ListDelta<MergedId> merged;
  ListDelta<std::string> display_name;  ///< of the map: one on each side, or none
  ListDelta<KeptClearRegion> kept_clear;
};

/// The difference between two states without tiles: submaps that are different objects in the two.
StateDelta DiffRows(const MapSnapshot& before, const MapSnapshot& after);

/// Adds the tiles as they are in memory, for callers that keep both states.
void AddTiles(const MapSnapshot& before, const MapSnapshot& after, StateDelta& delta);

}  // namespace dhpmap
