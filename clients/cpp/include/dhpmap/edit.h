// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dhpmap/geometry.h"
#include "dhpmap/object.h"
#include "dhpmap/result.h"

namespace dhpmap::client {

/// The object that an earlier edit of the same list creates; of several objects the one with the smallest id.
struct NewObject {
  int step = 0;
};

/// The object to edit: by id, as an Object (whose etag EditOptions::only_if_unedited checks), or a new object.
class Target {
 public:
  Target(std::int64_t id) : what_(id) {}                                  // NOLINT(google-explicit-constructor)
  Target(const Object& object) : what_(object.id), etag_(object.etag) {}  // NOLINT(google-explicit-constructor)
  Target(NewObject made) : what_(made) {}                                 // NOLINT(google-explicit-constructor)

  [[nodiscard]] const std::variant<std::int64_t, NewObject>& what() const { return what_; }
  [[nodiscard]] const std::string& etag() const { return etag_; }

 private:
  std::variant<std::int64_t, NewObject> what_;
  std::string etag_;
};

struct EditOptions {
  std::string author;                  ///< empty: that of ConnectOptions
  std::int64_t expected_revision = 0;  ///< Aborted, reason EDITED_SINCE, if an object of the edit was edited after it
  bool only_if_unedited = false;       ///< Aborted, reason ETAG_MISMATCH, if a given Object was edited since
  double deadline_s = 0;               ///< 0: that of ConnectOptions
};

/// The result of one edit, by ids of objects.
struct EditResult {
  std::vector<std::int64_t> changed, created, removed;
  std::int64_t num_voxels = 0;  ///< moved to new objects by a split, or cleared
};

struct Edited {
  std::int64_t revision = 0;        ///< of the map with the edits
  std::vector<EditResult> results;  ///< one for each edit, in their order
};

/// Collects edits. Apply makes them all as one revision or, with an error, none. Without Apply nothing is changed. For
/// one thread.
class Edit {
 public:
  Edit(Edit&&) noexcept;
  Edit& operator=(Edit&&) noexcept;
  ~Edit();

  // include_supported: objects that stand on it move with it. Each returns *this.
  Edit& MoveTo(const Target& object, const Pose& T_map_object, bool include_supported = false);
  Edit& MoveBy(const Target& object, const Vector3& by_m, bool include_supported = false);
  /// About the vertical through its centre, counterclockwise seen from above.
  Edit& Turn(const Target& object, double angle_rad, bool include_supported = false);
  /// Onto another object: over at_m, whose z is ignored, or over the centre of its upper side.
  Edit& Place(const Target& object, const Target& on, const std::optional<Vector3>& at_m = {},
              bool include_supported = false);

  Edit& Delete(const Target& object);
  Edit& Undelete(std::int64_t object);
  /// Changes to another class of the same kind.
  Edit& Relabel(const Target& object, std::string_view class_name);
  /// Sets the display name; "" makes it follow the class again.
  Edit& Rename(const Target& object, std::string_view name);
  /// Merges the others into this thing.
  Edit& Merge(const Target& object, std::span<const std::int64_t> others);
  Edit& SetPresent(const Target& object, bool is_present);
  /// Mapping does not change a locked object.
  Edit& SetLocked(const Target& object, bool is_locked);
  /// Removes observations in the region: those of these classes, or all.
  Edit& Clear(const Region& region, std::span<const std::string> class_names = {});
  /// Frames map nothing in the region from now on.
  Edit& IgnoreRegion(std::string_view name, const Region& region);
  Edit& UnignoreRegion(std::string_view name);

  // These create an object, to which later edits of the list may refer.
  /// A copy, at the original's pose unless one is given.
  NewObject Clone(const Target& object, const std::optional<Pose>& T_map_object = {}, std::string_view name = "");
  /// The part in the box becomes a new object; if it is split from stuff, class_name is the class of the new thing.
  NewObject Split(const Target& object, const Box& box, std::string_view class_name = "");

  /// The result that the edits so far would have; changes nothing. Fails as Apply would.
  Result<Edited> Preview() const;
  /// Makes the edits and empties the list. Returns once they are stored. If the answer is lost, retries with the same
  /// request id, so that they are made once.
  Result<Edited> Apply();

 private:
  friend class Map;
  struct Impl;
  explicit Edit(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

struct UndoOptions {
  int count = 1;              ///< number of the author's last edits
  std::int64_t revision = 0;  ///< if not 0: this edit instead, whoever made it
  std::string author;         ///< empty: that of ConnectOptions
};

struct RestoreOptions {
  std::optional<std::int64_t> object;  ///< only this object
  std::string author;                  ///< empty: that of ConnectOptions
};

/// The result of undo, redo or restore: edits by their revisions, objects by their ids.
struct Undone {
  std::int64_t revision = 0;
  std::vector<std::int64_t> edits, changed, created, removed;
};

}  // namespace dhpmap::client
