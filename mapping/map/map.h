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

/// All of a map but its submaps: one row of the store.
struct MapInfo {
  std::string name;  ///< [a-z0-9][a-z0-9._-]{0,62}, unique in a server
  std::string display_name;
  /// Of this map's ids and revisions: another for each map that is made, restored from a backup or imported, though its
  /// name be the same. 0: not drawn yet.
  std::uint64_t history_id = 0;
  MapConfig config;
  std::shared_ptr<const LabelSet> label_set = std::make_shared<LabelSet>();
  std::int64_t revision = 0;        ///< +1 with each published change
  std::int64_t num_frames = 0;      ///< frames fused so far
  SubmapId next_submap_id{1};       ///< ids are never reused
  std::int64_t create_time_ns = 0;  ///< UTC
  std::int64_t update_time_ns = 0;  ///< UTC
  SessionMarks sessions;            ///< of the frames fused so far
  MergedIds merged;                 ///< submaps that became parts of others
  ObjectPairs pairs;                ///< what is known of whether two submaps are one object
  KeptClear kept_clear;             ///< where mapping puts nothing
};

Status ValidateMapName(const std::string& name);

/// Where objects were that an edit has moved or deleted, and nobody has looked through: a layer like free space, of
/// which what the last edit has moved away may still have to be worked out, as that costs what the object is large.
struct VacatedSpace {
  std::shared_ptr<const FreeSpace> noted;  ///< null: nothing was left
  std::optional<SubmapId> leaving;         ///< an object of the state, moved in it and not before
};

/// A map at one revision: immutable, shared by readers, the store and the change feed. Thread-safe.
class MapSnapshot {
 public:
  /// Without `free_space` nothing is known to be free.
  MapSnapshot(MapInfo info, std::vector<std::shared_ptr<const Submap>> submaps,
              std::shared_ptr<const FreeSpace> free_space = nullptr, VacatedSpace vacated = {});

  [[nodiscard]] const MapInfo& info() const { return info_; }
  [[nodiscard]] std::int64_t revision() const { return info_.revision; }
  /// By ascending id; the first is the unknown submap, always there.
  [[nodiscard]] const std::vector<std::shared_ptr<const Submap>>& submaps() const { return submaps_; }
  /// Null if there is none.
  [[nodiscard]] const Submap* Find(SubmapId id) const;
  /// What sensors have looked through. Never null; snapshots of the same state share it.
  [[nodiscard]] const std::shared_ptr<const FreeSpace>& free_space() const { return free_space_; }
  /// Where objects were that an edit has moved or deleted, and nobody has looked through. A layer of the same kind: its
  /// voxels are those that an object left, its stamps are of the free space at that time. What is seen there since
  /// counts before it. Never null. Whoever asks first waits until it is worked out what leaving() has left.
  [[nodiscard]] const std::shared_ptr<const FreeSpace>& vacated() const;
  /// The same without what leaving() has left, at no cost. Never null.
  [[nodiscard]] const std::shared_ptr<const FreeSpace>& noted_vacated() const { return noted_vacated_; }
  /// What the edit that made this state has moved, if what it left is not in noted_vacated().
  [[nodiscard]] std::optional<SubmapId> leaving() const { return leaving_; }

 private:
  friend class Map;
  /// What is worked out once, for all snapshots of the same state.
  struct Vacated {
    Mutex mutex;
    std::shared_ptr<const FreeSpace> layer DHPMAP_GUARDED_BY(mutex);  ///< null: not yet; never changes afterwards
  };

  MapInfo info_;
  std::vector<std::shared_ptr<const Submap>> submaps_;
  std::shared_ptr<const FreeSpace> free_space_, noted_vacated_;
  std::optional<SubmapId> leaving_;
  std::shared_ptr<Vacated> vacated_;  ///< null: all is noted
};

/// The writer's map. Publishes immutable snapshots; what it then changes, it copies first, one submap row, one tile and
/// one block at a time, so a snapshot costs only what changes after it. Thread-compatible: one writer.
class Map {
 public:
  /// A map with nothing but the unknown submap. `info.config` must be valid.
  explicit Map(MapInfo info);
  /// Goes on from a published or loaded state.
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
  /// Adds a submap, without blocks, under the id that `info` has: one that was there before, and is not now.
  Submap& PutBack(SubmapInfo info);
  /// The unknown submap cannot be removed. Returns whether it was there. What was known of its pairs is forgotten. What
  /// is on the disk only is read, for states and clones that have it, too: throws StatusError where it cannot be now.
  bool Remove(SubmapId id);

  [[nodiscard]] const FreeSpace& free_space() const { return *free_space_; }
  /// The layer for writing. Valid until the next Publish.
  [[nodiscard]] FreeSpace& mutable_free_space() { return Writable(free_space_); }
  /// See MapSnapshot. Works out what was left, as that does; the second, for writing, is valid until the next Publish.
  [[nodiscard]] const FreeSpace& vacated();
  [[nodiscard]] FreeSpace& mutable_vacated();
  /// To be called when an object that was where it was seen (IsExclusive, nothing of it gone) has just been moved: what
  /// it left is worked out when somebody asks for it, or before anything else changes in a later revision.
  void NoteLeaving(SubmapId moved);
  /// Works it out now, from the state as it is now: before a further edit of the same revision.
  void SettleVacated();

  /// The present state as a snapshot. A new revision if anything was written since the last one, else the same
  /// snapshot.
  std::shared_ptr<const MapSnapshot> Publish(std::int64_t time_ns);
  [[nodiscard]] const std::shared_ptr<const MapSnapshot>& published() const { return published_; }
  /// Whether something was written since.
  [[nodiscard]] bool is_changed() const { return changed_; }

  /// Has the map, and its published state, leave voxels on the disk again that were read from there (see TilePage):
  /// what was not asked for since the last time, or with `even_used` all. It is the same revision and the same parts;
  /// who holds the state of before keeps what it has read. Returns the published state, which may be the one that it
  /// was. Does nothing while there is something that was not published.
  /// With a `spill` also what was written, or is not stored yet, goes there.
  std::shared_ptr<const MapSnapshot> LetGoOfPages(bool even_used, TileSpill* spill = nullptr);

  /// A second writer's map of the same state, published or not: to go back to by assigning it. Whatever either writes
  /// afterwards is copied first.
  [[nodiscard]] Map Fork();

  /// The present state, published or not, without making a revision of it: for work on the side such as refinement.
  /// Whatever is written afterwards is copied first.
  [[nodiscard]] std::shared_ptr<const MapSnapshot> Freeze();

 private:
  [[nodiscard]] std::size_t Position(SubmapId id) const;
  /// Before whatever changes the map.
  void BeginChange();
  /// A layer for writing, copied if a snapshot may hold it.
  [[nodiscard]] FreeSpace& Writable(std::shared_ptr<const FreeSpace>& layer);
  /// A layer as it is now, which nobody writes to any more.
  [[nodiscard]] std::shared_ptr<const FreeSpace> Frozen(const std::shared_ptr<const FreeSpace>& layer) const;

  MapInfo info_;
  std::uint64_t generation_ = 1;  ///< before the layers, which start with it
  std::vector<std::shared_ptr<const Submap>> submaps_;
  std::shared_ptr<const FreeSpace> free_space_, vacated_;  ///< never null
  std::optional<SubmapId> leaving_;                        ///< of which vacated_ does not know yet what it left
  std::shared_ptr<const MapSnapshot> published_;
  bool changed_ = true;
  std::uint64_t parts_before_ = 0, parts_now_ = 0;  ///< names of parts from the last revision on, and from this one
};

}  // namespace dhpmap
