// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/map.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <unordered_map>
#include <utility>

#include "mapping/base/status_error.h"
#include "mapping/map/left_space.h"
#include "mapping/paging/page_reader.h"
#include "mapping/paging/tile_evictor.h"
#include "mapping/paging/tile_spill.h"

namespace dhpmap {
namespace {

using SubmapList = std::vector<std::shared_ptr<const Submap>>;

SubmapList::const_iterator LowerBound(const SubmapList& submaps, SubmapId id) {
  return std::lower_bound(submaps.begin(), submaps.end(), id,
                          [](const auto& submap, SubmapId wanted) { return submap->id() < wanted; });
}

const Submap* FindIn(const SubmapList& submaps, SubmapId id) {
  const auto it = LowerBound(submaps, id);
  return it != submaps.end() && (*it)->id() == id ? it->get() : nullptr;
}

/// Reads tiles that are only on disk. Their blobs are deleted with the submap, but older states and clones still need
/// them. Throws StatusError if the list of tiles cannot be read now but is not lost: the call may be repeated later.
void ReadAll(const Submap& submap) {
  const auto is_lost = [](StatusCode code) {
    return code == StatusCode::kDataLoss || code == StatusCode::kFailedPrecondition || code == StatusCode::kAborted;
  };
  std::span<const TileEntry> tiles;
  try {
    tiles = submap.blocks().tiles();
  } catch (const StatusError& error) {
    if (!is_lost(error.status().code())) throw;
  }
  for (const TileEntry& tile : tiles) {
    if (tile.tile->loader() != nullptr && tile.tile->loader()->HasOwnNames()) continue;  // spilled: stays on disk
    try {
      (void)tile.tile->entries();
    } catch (const StatusError&) {
      continue;  // a later read through an older state returns the error
    }
  }
}

}  // namespace

Status ValidateMapName(const std::string& name) {
  const auto is_word = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  const bool good =
      !name.empty() && name.size() <= 63 && is_word(name[0]) &&
      std::all_of(name.begin(), name.end(), [&](char c) { return is_word(c) || c == '.' || c == '_' || c == '-'; });
  if (good) return Status::Ok();
  return InvalidArgument(std::string("'").append(name, 0, 80).append("' is not a map name"))
      .WithReason("BAD_NAME")
      .WithViolation("map", "1 to 63 of a-z 0-9 . _ -, the first a letter or digit");
}

MapSnapshot::MapSnapshot(MapInfo info, SubmapList submaps, std::shared_ptr<const FreeSpace> free_space,
                         VacatedSpace vacated)
    : info_(std::move(info)),
      submaps_(std::move(submaps)),
      free_space_(free_space != nullptr ? std::move(free_space) : std::make_shared<const FreeSpace>()),
      noted_vacated_(vacated.noted != nullptr ? std::move(vacated.noted) : std::make_shared<const FreeSpace>()),
      leaving_(vacated.leaving && Find(*vacated.leaving) != nullptr ? vacated.leaving : std::nullopt),
      vacated_(leaving_ ? std::make_shared<Vacated>() : nullptr) {}

const std::shared_ptr<const FreeSpace>& MapSnapshot::vacated() const {
  if (vacated_ == nullptr) return noted_vacated_;
  const MutexLock lock(vacated_->mutex);
  if (vacated_->layer == nullptr) {
    const PageReader::Passing passing;  // the result is for all readers, so it must not count for this one
    vacated_->layer = WithLeft({*Find(*leaving_), submaps_, info_.config, *free_space_}, noted_vacated_);
  }
  return vacated_->layer;
}

const Submap* MapSnapshot::Find(SubmapId id) const { return FindIn(submaps_, id); }

Map::Map(MapInfo info)
    : info_(std::move(info)),
      free_space_(std::make_shared<FreeSpace>(generation_)),
      vacated_(std::make_shared<FreeSpace>(generation_)) {
  SubmapInfo unknown;
  unknown.id = kUnknownSubmap;
  unknown.display_name = "unknown";
  unknown.voxel_size_m = info_.config.voxel_size_m;
  unknown.truncation_m = info_.config.truncation_m;
  submaps_.push_back(std::make_shared<Submap>(std::move(unknown), generation_));
}

Map::Map(std::shared_ptr<const MapSnapshot> snapshot)
    : info_(snapshot->info()),
      submaps_(snapshot->submaps()),
      free_space_(snapshot->free_space()),
      vacated_(snapshot->noted_vacated()),
      leaving_(snapshot->leaving()),
      published_(std::move(snapshot)),
      changed_(false) {
  // The snapshot's blocks carry older generations, of this process or 0: start above all of them.
  for (const auto& submap : submaps_) generation_ = std::max(generation_, submap->generation() + 1);
  generation_ = std::max({generation_, free_space_->generation() + 1, vacated_->generation() + 1});
}

void Map::BeginChange() {
  if (!changed_) SettleVacated();
  changed_ = true;
}

void Map::SettleVacated() {
  if (!leaving_) return;
  if (const Submap* moved = Find(*leaving_); changed_ && moved != nullptr) {
    auto with_left = std::make_shared<FreeSpace>(*WithLeft({*moved, submaps_, info_.config, *free_space_}, vacated_));
    with_left->ShareTiles();
    with_left->set_generation(generation_);
    vacated_ = std::move(with_left);
  } else if (!changed_) {
    vacated_ = published_->vacated();
  }
  leaving_.reset();
}

void Map::NoteLeaving(SubmapId moved) {
  SettleVacated();
  leaving_ = moved;
}

const FreeSpace& Map::vacated() {
  SettleVacated();
  return *vacated_;
}

FreeSpace& Map::mutable_vacated() {
  SettleVacated();
  return Writable(vacated_);
}

MapInfo& Map::mutable_info() {
  BeginChange();
  return info_;
}

const Submap* Map::Find(SubmapId id) const { return FindIn(submaps_, id); }

std::size_t Map::Position(SubmapId id) const {
  return static_cast<std::size_t>(LowerBound(submaps_, id) - submaps_.begin());
}

Submap* Map::FindMutable(SubmapId id) {
  const std::size_t position = Position(id);
  if (position == submaps_.size() || submaps_[position]->id() != id) return nullptr;
  BeginChange();
  auto& submap = submaps_[position];
  if (submap->generation() != generation_) {
    auto copy = std::make_shared<Submap>(*submap);
    copy->set_generation(generation_);
    submap = std::move(copy);
  }
  return const_cast<Submap*>(submap.get());  // made by this generation: no snapshot holds it
}

Submap& Map::Create(SubmapInfo info) {
  BeginChange();
  info.id = info_.next_submap_id++;
  auto submap = std::make_shared<Submap>(std::move(info), generation_);
  Submap& created = *submap;
  submaps_.push_back(std::move(submap));  // ids only grow: the list stays sorted
  return created;
}

Submap* Map::Clone(SubmapId id) {
  const Submap* original = Find(id);
  if (original == nullptr) return nullptr;
  BeginChange();
  // From here on both share the same blocks, so neither may write them in place: blocks of this generation must count
  // as old. If a snapshot holds the original, nothing of it is written in place anyway.
  if (original->generation() == generation_) FindMutable(id)->ShareBlocks();
  auto copy = std::make_shared<Submap>(*original);
  copy->set_generation(generation_);
  copy->ShareBlocks();
  copy->mutable_info().id = info_.next_submap_id++;
  copy->mutable_info().track_id = 0;
  copy->mutable_info().sightings = {};
  copy->mutable_info().is_locked = false;
  Submap& cloned = *copy;
  submaps_.push_back(std::move(copy));
  return &cloned;
}

Submap& Map::PutBack(SubmapInfo info) {
  BeginChange();
  const std::size_t position = Position(info.id);
  assert(info.id < info_.next_submap_id && (position == submaps_.size() || submaps_[position]->id() != info.id));
  auto submap = std::make_shared<Submap>(std::move(info), generation_);
  Submap& back = *submap;
  submaps_.insert(submaps_.begin() + static_cast<std::ptrdiff_t>(position), std::move(submap));
  return back;
}

bool Map::Remove(SubmapId id) {
  const std::size_t position = Position(id);
  if (id == kUnknownSubmap || position == submaps_.size() || submaps_[position]->id() != id) return false;
  BeginChange();
  ReadAll(*submaps_[position]);
  submaps_.erase(submaps_.begin() + static_cast<std::ptrdiff_t>(position));
  info_.pairs.Remove(id);
  return true;
}

FreeSpace& Map::Writable(std::shared_ptr<const FreeSpace>& layer) {
  BeginChange();
  if (layer->generation() != generation_) {
    auto copy = std::make_shared<FreeSpace>(*layer);
    copy->set_generation(generation_);
    layer = std::move(copy);
  }
  return const_cast<FreeSpace&>(*layer);  // made by this generation: no snapshot holds it
}

std::shared_ptr<const MapSnapshot> Map::Publish(std::int64_t time_ns) {
  if (!changed_ && published_ != nullptr) return published_;
  ++info_.revision;
  info_.update_time_ns = time_ns;
  for (auto& submap : submaps_) {
    if (submap->generation() == generation_) {
      const_cast<Submap&>(*submap).mutable_info().revision = info_.revision;  // not shared before this publish
    }
  }
  published_ = std::make_shared<MapSnapshot>(info_, submaps_, free_space_, VacatedSpace{vacated_, leaving_});
  ++generation_;
  changed_ = false;
  parts_before_ = std::exchange(parts_now_, PartId().value());
  return published_;
}

std::shared_ptr<const MapSnapshot> Map::EvictPages(bool even_used, TileSpill* spill) {
  if (changed_ || published_ == nullptr) return published_;
  std::unordered_map<const BlockTile*, std::shared_ptr<const BlockTile>> left;
  const EvictionRule rule{.even_used = even_used, .spill = spill, .written_lately = parts_before_, .left = &left};
  SubmapList same = submaps_;  // all of older generations: the writer owns none
  bool has_any = false;
  for (auto& submap : same) {
    auto without = submap->WithTiles(TileEvictor(rule));
    if (without == nullptr) continue;
    submap = std::move(without);
    has_any = true;
  }
  if (!has_any) return published_;
  auto next = std::make_shared<MapSnapshot>(info_, same, free_space_, VacatedSpace{vacated_, leaving_});
  next->vacated_ = published_->vacated_;
  published_ = std::move(next);
  submaps_ = std::move(same);
  return published_;
}

Map Map::Fork() {
  Map fork = *this;
  for (auto& submap : fork.submaps_) {
    if (submap->generation() != generation_) continue;  // both copy it before they write
    const_cast<Submap&>(*submap).ShareBlocks();         // made by this generation: no snapshot holds it
    submap = std::make_shared<const Submap>(*submap);
  }
  fork.free_space_ = Frozen(free_space_);
  fork.vacated_ = Frozen(vacated_);
  return fork;
}

Map Map::ForkInPlace() {
  Map fork = *this;
  for (std::size_t i = 0; i < submaps_.size(); ++i) {
    if (submaps_[i]->generation() != generation_) continue;  // this map copies it before it writes
    fork.submaps_[i] = std::make_shared<const Submap>(*submaps_[i]);
    const_cast<Submap&>(*submaps_[i]).ForkBlocks();  // made by this generation: no snapshot holds it
  }
  fork.free_space_ = Frozen(free_space_);
  fork.vacated_ = Frozen(vacated_);
  return fork;
}

std::shared_ptr<const MapSnapshot> Map::Freeze() {
  std::vector<std::shared_ptr<const Submap>> frozen;
  for (auto& submap : submaps_) {
    if (submap->generation() == generation_) {
      const_cast<Submap&>(*submap).ShareBlocks();  // made by this generation: no snapshot holds it
    }
    frozen.push_back(std::make_shared<const Submap>(*submap));
  }
  auto state = std::make_shared<MapSnapshot>(info_, std::move(frozen), Frozen(free_space_),
                                             VacatedSpace{Frozen(vacated_), leaving_});
  if (!changed_ && published_ != nullptr) state->vacated_ = published_->vacated_;
  return state;
}

std::shared_ptr<const FreeSpace> Map::Frozen(const std::shared_ptr<const FreeSpace>& layer) const {
  if (layer->generation() != generation_) return layer;  // copied before it is written to
  const_cast<FreeSpace&>(*layer).ShareTiles();           // made by this generation: no snapshot holds it
  return std::make_shared<const FreeSpace>(*layer);
}

}  // namespace dhpmap
