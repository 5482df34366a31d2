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

class Caller;  // inner: the connection

/// A class of a map's label set.
struct Label {
  enum class Size { kSmall, kMedium, kLarge };

  std::int32_t id = 0;  ///< 0 to 65534
  std::string name;
  Kind kind = Kind::kThing;
  Size size = Size::kMedium;  ///< decides how many points a new object needs
};

/// A map as a whole, at one revision.
struct MapInfo {
  std::string name;
  std::string title;  ///< for people
  std::int64_t revision = 0;
  std::int64_t num_frames = 0;
  std::int64_t num_objects = 0;  ///< the unknown object 0 is none
  double voxel_size_m = 0;
  std::vector<Label> classes;  ///< not of Client::Maps
  std::string history_id;      ///< another one for each map that is made or restored
  std::string etag;
};

/// All objects, at one revision: watch from there to follow them.
struct ObjectList {
  std::int64_t revision = 0;  ///< of the oldest page
  std::vector<Object> objects;
};

/// A map of a server, as it is whenever it is asked. Copies are the same map. Safe for use from several threads.
class Map final : public Queries {
 public:
  /// The last part of its resource name.
  [[nodiscard]] std::string name() const;

  /// Revision, counts and classes, as they are now.
  Result<MapInfo> Info() const;
  /// By ascending id, the unknown object and those that are absent included.
  Result<ObjectList> Objects() const;
  /// NotFound, reason SUBMAP_NOT_FOUND, or MERGED_INTO with `merged_into` in the metadata.
  Result<Object> Get(std::int64_t object) const;

  /// The present state, to be asked several things about.
  Result<Pinned> Pin() const;
  /// The map as it was at a revision of the recent past.
  [[nodiscard]] Pinned At(std::int64_t revision) const;
  /// Queries on one stream.
  [[nodiscard]] client::Loop Loop() const;

  [[nodiscard]] client::Edit Edit(const EditOptions& options = {}) const;
  /// Takes the last edits of an author back. Aborted, reason UNDO_CONFLICT, where others have changed the same since;
  /// FailedPrecondition, reason NOTHING_TO_UNDO.
  Result<Undone> Undo(const UndoOptions& options = {}) const;
  /// Does again what was undone.
  Result<Undone> Redo(const UndoOptions& options = {}) const;

  /// Takes all of the map, or one object, back to a revision of the recent past: an edit, which can be undone.
  Result<Undone> Restore(std::int64_t revision, const RestoreOptions& options = {}) const;
  /// The edits that there were, the newest first.
  Result<std::vector<LoggedEdit>> Log(const LogOptions& options = {}) const;

  [[nodiscard]] client::Watch Watch(const WatchOptions& options = {}) const;
  /// Begins a session of frames. Aborted, reason MAP_IS_FED, if a stream without a session feeds the map.
  Result<client::Feed> Feed(const FeedOptions& options) const;
  /// The surface as a file, such as a binary PLY. NotFound for an object that is not there.
  Result<FileInfo> Mesh(const TakePart& take, const MeshOptions& options = {}) const;
  /// The observed voxels of an object.
  Result<client::Voxels> Voxels(std::int64_t object, const VoxelOptions& options = {}) const;
  /// All of the map as committed, as a file that Client::ImportMap reads.
  Result<FileInfo> Export(const TakePart& take, double deadline_s = 3600) const;

  /// Settles all things and refines labels, which takes up to minutes. Mapping may go on later. The revision.
  Result<std::int64_t> FinishMapping(double deadline_s = 3600) const;

 private:
  friend class Client;
  Map(std::shared_ptr<Caller> caller, std::string resource_name);

  std::shared_ptr<Caller> caller_;
  std::string resource_name_;  // maps/{map}
};

}  // namespace dhpmap::client
