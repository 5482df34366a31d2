// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

// The difference between two states of a map, both sides of it: what it takes to go from either to the other. Free
// space, which edits leave alone, is no part of it.

/// A tile of a submap. Of each side the layers that differ; null: it had none of them.
struct TileDelta {
  TileIndex index;
  BlockLayers differs{};
  std::shared_ptr<const BlockTile> before, after;
};

/// All of a submap but its blocks.
struct SubmapRowState {
  SubmapInfo info;
  BoundingSphere sphere;
};

struct SubmapDelta {
  SubmapId id;
  std::optional<SubmapRowState> before, after;  ///< nothing: it was not there
  std::vector<TileDelta> tiles;
};

/// A tile of the vacated space; null: it was not there.
struct VacatedDelta {
  TileIndex index;
  std::shared_ptr<const FreeTile> before, after;
};

/// Of lists: the entries that one side has and the other has not, or has otherwise.
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
  ListDelta<std::string> display_name;  ///< of the map: one of each, or none
  ListDelta<KeptClearRegion> kept_clear;
};

/// All of the difference between two states but its tiles: submaps that are not the same object in both.
StateDelta DiffRows(const MapSnapshot& before, const MapSnapshot& after);

/// Adds the tiles, as they are in memory: for who keeps the states.
void AddTiles(const MapSnapshot& before, const MapSnapshot& after, StateDelta& delta);

}  // namespace dhpmap
