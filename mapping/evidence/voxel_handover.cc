// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/voxel_handover.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "mapping/evidence/block_position.h"
#include "mapping/evidence/known_instances.h"

namespace dhpmap {
namespace {

Position PositionOf(std::span<const Handover> handovers, const Map& map) {
  Position position{.index = handovers.front().block, .holders = {}};
  std::vector<SubmapId> ids;
  for (const Handover& handover : handovers) ids.insert(ids.end(), {handover.from, handover.to});
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (const SubmapId id : ids) {
    const BlockEntry* entry = map.Find(id)->blocks().Find(position.index);
    position.holders.push_back({.id = id, .before = entry != nullptr ? *entry : BlockEntry{.index = position.index}});
  }
  return position;
}

/// Others that hold something at the position keep it.
void Move(const Handover& handover, Position& position) {
  Holder &from = position.HolderOf(handover.from), &to = position.HolderOf(handover.to);
  MergedVoxel merged;
  for (const Holder* holder : {std::min(&from, &to), std::max(&from, &to)}) {  // by ascending id
    if (holder->Holds(handover.linear)) Accumulate(holder->before, holder->id, handover.linear, merged);
  }
  position.Take(handover.linear, from);
  position.Give(handover.linear, merged, handover.to, handover.is_concluded);
}

bool IsSameVoxel(const Handover& a, const Handover& b) { return a.block == b.block && a.linear == b.linear; }

}  // namespace

void HandOver(ScratchVector<Handover> handovers, Map& map, ThreadPool& pool) {
  std::sort(handovers.begin(), handovers.end(), [](const Handover& a, const Handover& b) {
    return std::tie(a.block, a.linear, a.from) < std::tie(b.block, b.linear, b.from);
  });
  // Where a voxel stays, only its bit is written: geometry that is the same objects keeps all that was made of it.
  for (const Handover& handover : handovers) {
    if (handover.from != handover.to) continue;
    map.FindMutable(handover.to)->MutableLabels(handover.block).SetConcluded(handover.linear, handover.is_concluded);
  }
  std::erase_if(handovers, [](const Handover& handover) { return handover.from == handover.to; });
  handovers.erase(std::unique(handovers.begin(), handovers.end(), IsSameVoxel), handovers.end());

  ScratchVector<std::span<const Handover>> places;
  for (std::size_t begin = 0, end = 0; begin < handovers.size(); begin = end) {
    while (end < handovers.size() && handovers[end].block == handovers[begin].block) ++end;
    places.emplace_back(handovers.data() + begin, end - begin);
  }
  std::vector<SubmapId> changed;
  for (std::size_t begin = 0; begin < places.size(); begin += kPositionsAtOnce) {
    ScratchVector<Position> positions(std::min(kPositionsAtOnce, places.size() - begin));
    pool.ParallelFor(positions.size(), [&](std::size_t i) {
      positions[i] = PositionOf(places[begin + i], map);
      for (const Handover& handover : places[begin + i]) Move(handover, positions[i]);
      positions[i].DropEmptyBlocks();
    });
    for (Position& position : positions) PutPosition(position, map, changed);
  }
  TidySubmaps(std::move(changed), map);
}

std::int64_t ForgetConclusions(std::span<const SubmapId> ids, Map& map, ThreadPool& pool) {
  const KnownInstances known(ids, map);
  ScratchVector<Handover> handovers;
  for (const SubmapId id : known.ids()) {
    for (const BlockEntry& entry : map.Find(id)->blocks().entries()) {
      if (entry.labels == nullptr || HasNone(entry.labels->concluded())) continue;
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (!entry.labels->IsConcluded(i) || !entry.Shows(i)) continue;
        const SubmapId home = known.MostSeen(id, *entry.labels, i);
        handovers.push_back({entry.index, static_cast<std::uint16_t>(i), id, home, false});
      }
    }
  }
  const auto num = static_cast<std::int64_t>(handovers.size());
  HandOver(std::move(handovers), map, pool);
  return num;
}

}  // namespace dhpmap
