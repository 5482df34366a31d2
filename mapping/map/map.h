// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "mapping/free/free_space.h"
#include "mapping/labels/label_set.h"
#include "mapping/map/kept_clear.h"
#include "mapping/map/map_config.h"
#include "mapping/map/merged_ids.h"
#include "mapping/map/object_pairs.h"
#include "mapping/map/session_marks.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

class TileSpill;

/// All of a map except its submaps: one row of the store.
struct MapInfo {
  std::string name;  ///< [a-z0-9][a-z0-9._-]{0,62}, unique in a server
  std::string display_name;
  /// Identifies the sequence of this map's ids and revisions: new for each map that is created, restored or imported,
  /// even under the same name. 0: not drawn yet.
  std::uint64_t history_id = 0;
  MapConfig config;
  std::shared_ptr<const LabelSet> label_set = std::make_shared<LabelSet>();
  std::int64_t revision = 0;        ///< +1 with each published change
  std::int64_t num_frames = 0;      ///< frames fused so far
  SubmapId next_submap_id{1};       ///< ids are never reused
  std::int64_t create_time_ns = 0;  ///< UTC
  std::int64_t update_time_ns = 0;  ///< UTC
  SessionMarks sessions;            ///< progress of feed sessions, up to the frames fused so far
  MergedIds merged;                 ///< submaps that were merged into others
  ObjectPairs pairs;                ///< evidence on whether two submaps are one object
  KeptClear kept_clear;             ///< ignored regions
};

Status ValidateMapName(const std::string& name);

/// Space that moved or deleted objects occupied and no sensor has seen since: a layer like free space. The part of the
/// last edit may be computed later, because it takes time linear in the object's size.
struct VacatedSpace {
  std::shared_ptr<const FreeSpace> noted;  ///< null: nothing is vacated
  std::optional<SubmapId> leaving;  ///< the object that the last edit moved, if its old place is not in `noted` yet
};

/// A map at one revision: immutable, shared by readers, the store and the change feed. Thread-safe.
class MapSnapshot {
 public:
  /// Without `free_space`, no space is known to be free.
  MapSnapshot(MapInfo info, std::vector<std::shared_ptr<const Submap>> submaps,
              std::shared_ptr<const FreeSpace> free_space = nullptr, VacatedSpace vacated = {});

  [[nodiscard]] const MapInfo& info() const { return info_; }
  [[nodiscard]] std::int64_t revision() const { return info_.revision; }
  /// By ascending id; the first is the unknown submap, which always exists.
  [[nodiscard]] const std::vector<std::shared_ptr<const Submap>>& submaps() const { return submaps_; }
  /// Null if there is none.
  [[nodiscard]] const Submap* Find(SubmapId id) const;
  /// The free-space layer. Never null; snapshots of the same state share it.
  [[nodiscard]] const std::shared_ptr<const FreeSpace>& free_space() const { return free_space_; }
  /// Vacated space: a layer of the same kind. Its voxels are those that objects left, its stamps those of the free
  /// space at that time; later observations take precedence. Never null. The first call may compute the old place of
  /// leaving(), and concurrent callers wait for it.
  [[nodiscard]] const std::shared_ptr<const FreeSpace>& vacated() const;
  /// The same without the old place of leaving(), at no cost. Never null.
  [[nodiscard]] const std::shared_ptr<const FreeSpace>& noted_vacated() const { return noted_vacated_; }
  /// The object that the edit of this state moved, if its old place is not in noted_vacated() yet.
  [[nodiscard]] std::optional<SubmapId> leaving() const { return leaving_; }

 private:
  friend class Map;
  /// Computed once for all snapshots of the same state.
  struct Vacated {
    Mutex mutex;
    std::shared_ptr<const FreeSpace> layer DHPMAP_GUARDED_BY(mutex);  ///< null until computed, then constant
  };

  MapInfo info_;
  std::vector<std::shared_ptr<const Submap>> submaps_;
  std::shared_ptr<const FreeSpace> free_space_, noted_vacated_;
  std::optional<SubmapId> leaving_;
  std::shared_ptr<Vacated> vacated_;  ///< null: noted_vacated() is complete
};

/// The writer's map. It publishes immutable snapshots and copies on write: a submap row, a tile, a block. A snapshot
/// thus costs only the later changes. Thread-compatible: one writer.
class Map {
 public:
  /// A map that has only the unknown submap. `info.config` must be valid.
  explicit Map(MapInfo info);
  /// Continues from a published or loaded state.
  explicit Map(std::shared_ptr<const MapSnapshot> snapshot);

  [[nodiscard]] const MapInfo& info() const { return info_; }
  /// Changing it makes the next Publish a new revision.
  [[nodiscard]] MapInfo& mutable_info();

  /// By ascending id.
  [[nodiscard]] const std::vector<std::shared_ptr<const Submap>>& submaps() const { return submaps_; }
  [[nodiscard]] const Submap* Find(SubmapId id) const;
  /// The submap for writing; null if there is none. Valid until the next Publish or until it is removed.
  [[nodiscard]] Submap* FindMutable(SubmapId id);

  /// Adds a submap with the next id; `info.id` is ignored.
  Submap& Create(SubmapInfo info);
  /// Adds a copy of a submap under the next id, sharing its blocks, not locked; null if there is none. See also Submap.
  Submap* Clone(SubmapId id);
  /// Adds a submap without blocks under `info.id`, an id that was used before and is free now.
  Submap& PutBack(SubmapInfo info);
  /// Returns whether the submap was there; the unknown submap cannot be removed. Forgets the evidence of its pairs.
  /// First reads its evicted tiles, for states and clones that share them: throws StatusError if that fails.
  bool Remove(SubmapId id);

  [[nodiscard]] const FreeSpace& free_space() const { return *free_space_; }
  /// The free-space layer for writing. Valid until the next Publish.
  [[nodiscard]] FreeSpace& mutable_free_space() { return Writable(free_space_); }
  /// See MapSnapshot; both compute what is missing. The second, for writing, is valid until the next Publish.
  [[nodiscard]] const FreeSpace& vacated();
  [[nodiscard]] FreeSpace& mutable_vacated();
  /// Call just after moving an object that was where it was seen (IsExclusive, no surface of it gone). Its old place is
  /// computed on demand, or before the next revision changes anything else.
  void NoteLeaving(SubmapId moved);
  /// Computes it now, from the present state: before another edit of the same revision.
  void SettleVacated();

  /// The present state as a snapshot: a new revision if anything was written, else the last snapshot.
  std::shared_ptr<const MapSnapshot> Publish(std::int64_t time_ns);
  [[nodiscard]] const std::shared_ptr<const MapSnapshot>& published() const { return published_; }
  /// Whether anything was written since.
  [[nodiscard]] bool is_changed() const { return changed_; }

  /// Evicts pages (see TilePage) from the map and its published state: those not used since the last call, or all with
  /// `even_used`. Given a `spill`, it also evicts tiles that were written or are not stored yet. Revision and parts
  /// stay the same; holders of the old snapshot keep what they have read. Returns the published state, which may be
  /// unchanged. Does nothing while there are unpublished changes.
  std::shared_ptr<const MapSnapshot> EvictPages(bool even_used, TileSpill* spill = nullptr);

  /// A second map of the same state, published or not, to roll back to by assignment. Both copy on write.
  [[nodiscard]] Map Fork();
  /// The same, to go back to before anything else is done with either map: what this one writes by
  /// Submap::BlockInPlace is also in the fork, until the writer has taken it back.
  [[nodiscard]] Map ForkInPlace();

  /// The present state, published or not, without a new revision: for background work such as refinement. Later writes
  /// copy first.
  [[nodiscard]] std::shared_ptr<const MapSnapshot> Freeze();

 private:
  [[nodiscard]] std::size_t Position(SubmapId id) const;
  /// Precedes every change of the map.
  void BeginChange();
  /// A layer for writing, copied if a snapshot may hold it.
  [[nodiscard]] FreeSpace& Writable(std::shared_ptr<const FreeSpace>& layer);
  /// A layer as it is now, without a writer.
  [[nodiscard]] std::shared_ptr<const FreeSpace> Frozen(const std::shared_ptr<const FreeSpace>& layer) const;

  MapInfo info_;
  std::uint64_t generation_ = 1;  ///< before the layers, which start with it
  std::vector<std::shared_ptr<const Submap>> submaps_;
  std::shared_ptr<const FreeSpace> free_space_, vacated_;  ///< never null
  std::optional<SubmapId> leaving_;                        ///< not yet in vacated_
  std::shared_ptr<const MapSnapshot> published_;
  bool changed_ = true;
  std::uint64_t parts_before_ = 0, parts_now_ = 0;  ///< first part names of the last revision, and of this one
};

}  // namespace dhpmap
