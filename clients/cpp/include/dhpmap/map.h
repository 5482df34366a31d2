// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dhpmap/edit.h"
#include "dhpmap/feed.h"
#include "dhpmap/files.h"
#include "dhpmap/history.h"
#include "dhpmap/queries.h"
#include "dhpmap/watch.h"

namespace dhpmap::client {

class Caller;  // internal: the connection

/// A class of a map's label set.
struct Label {
  enum class Size { kSmall, kMedium, kLarge };

  std::int32_t id = 0;  ///< 0 to 65534
  std::string name;
  Kind kind = Kind::kThing;
  Size size = Size::kMedium;  ///< decides how many points a new object needs
};

/// Properties of a map at one revision.
struct MapInfo {
  std::string name;
  std::string title;  ///< display name
  std::int64_t revision = 0;
  std::int64_t num_frames = 0;
  std::int64_t num_objects = 0;  ///< without the unknown object 0
  double voxel_size_m = 0;
  std::vector<Label> classes;  ///< empty in Client::Maps
  std::string history_id;      ///< changes when a map is created or restored
  std::string etag;
};

/// All objects at one revision: watch from there to follow changes.
struct ObjectList {
  std::int64_t revision = 0;  ///< of the oldest page
  std::vector<Object> objects;
};

/// A map of a server; each call uses its current state. Copies refer to the same map. Thread-safe.
class Map final : public Queries {
 public:
  /// The last part of its resource name.
  [[nodiscard]] std::string name() const;

  /// Revision, counts and classes of the current state.
  Result<MapInfo> Info() const;
  /// Sorted by id, including the unknown object and absent objects.
  Result<ObjectList> Objects() const;
  /// NotFound, reason SUBMAP_NOT_FOUND, or MERGED_INTO with `merged_into` in the metadata.
  Result<Object> Get(std::int64_t object) const;

  /// Pins the current state for several queries.
  Result<Pinned> Pin() const;
  /// The map at a recent revision.
  [[nodiscard]] Pinned At(std::int64_t revision) const;
  /// The map as the contacted server has it. If several servers share a database, that may be a copy some tenths of a
  /// second behind its owner. Answers never go back in time; with min_revision they wait until the copy is there.
  [[nodiscard]] EventualMap Eventual() const;
  /// Queries on one stream.
  [[nodiscard]] client::Loop Loop() const;

  [[nodiscard]] client::Edit Edit(const EditOptions& options = {}) const;
  /// Undoes the last edits of an author. Aborted, reason UNDO_CONFLICT, if others have changed the same objects since;
  /// FailedPrecondition, reason NOTHING_TO_UNDO.
  Result<Undone> Undo(const UndoOptions& options = {}) const;
  /// Redoes undone edits.
  Result<Undone> Redo(const UndoOptions& options = {}) const;

  /// Restores the map, or one object, to a recent revision. This is an edit and can be undone.
  Result<Undone> Restore(std::int64_t revision, const RestoreOptions& options = {}) const;
  /// The log of edits, newest first.
  Result<std::vector<LoggedEdit>> Log(const LogOptions& options = {}) const;

  [[nodiscard]] client::Watch Watch(const WatchOptions& options = {}) const;
  /// Starts a feed session. Aborted, reason MAP_IS_FED, if a stream without a session feeds the map.
  Result<client::Feed> Feed(const FeedOptions& options) const;
  /// The surface as a file, such as a binary PLY. NotFound for a missing object.
  Result<FileInfo> Mesh(const TakePart& take, const MeshOptions& options = {}) const;
  /// The observed voxels of an object.
  Result<client::Voxels> Voxels(std::int64_t object, const VoxelOptions& options = {}) const;
  /// The whole map as committed, as a file for Client::ImportMap.
  Result<FileInfo> Export(const TakePart& take, double deadline_s = 3600) const;

  /// Deactivates all things and refines labels, which takes up to minutes. Mapping may continue later. Returns the
  /// revision.
  Result<std::int64_t> FinishMapping(double deadline_s = 3600) const;

 private:
  friend class Client;
  Map(std::shared_ptr<Caller> caller, std::string resource_name);

  std::shared_ptr<Caller> caller_;
  std::string resource_name_;  // maps/{map}
};

}  // namespace dhpmap::client
