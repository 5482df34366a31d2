// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// Tells later which blocks of a state were written since, without keeping the state: layers are told apart by their
/// identity, and only their names stay, some 150 bytes a block. Immutable, thread-safe.
class StateMarks {
 public:
  explicit StateMarks(const MapSnapshot& state);

  /// Whether the submap had this block, with these very layers.
  [[nodiscard]] bool Has(SubmapId submap, const BlockEntry& entry) const;

 private:
  struct Block {
    BlockIndex index;
    // Empty where there was no layer. They keep a layer's name from being given to another, but not the layer.
    std::weak_ptr<const TsdfBlock> tsdf;
    std::weak_ptr<const LabelBlock> labels;
    std::weak_ptr<const GoneBlock> gone;
  };
  std::map<SubmapId, std::vector<Block>> submaps_;  // blocks by ascending index
};

}  // namespace dhpmap
