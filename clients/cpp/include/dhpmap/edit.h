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

/// What an earlier edit of the same list makes; of several objects the one with the smallest id.
struct NewObject {
  int step = 0;
};

/// What is edited: an object by its id, one as it was got (which EditOptions::only_if_unedited looks at), or a new one.
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
  std::int64_t expected_revision = 0;  ///< Aborted, reason EDITED_SINCE, if what is named was edited after it
  bool only_if_unedited = false;       ///< Aborted, reason ETAG_MISMATCH, if an Object that is passed was edited since
  double deadline_s = 0;               ///< 0: that of ConnectOptions
};

/// What one edit did, by ids of objects.
struct EditResult {
  std::vector<std::int64_t> changed, created, removed;
  std::int64_t num_voxels = 0;  ///< that a split gave to new objects, or that were cleared
};

struct Edited {
  std::int64_t revision = 0;        ///< of the map, that has the edits
  std::vector<EditResult> results;  ///< one an edit, in their order
};

/// Collects edits; Apply does them all as one revision, or, with an error, none. Without Apply nothing is done.
/// For one thread.
class Edit {
 public:
  Edit(Edit&&) noexcept;
  Edit& operator=(Edit&&) noexcept;
  ~Edit();

  // include_supported: what stands on it goes along. Each returns *this.
  Edit& MoveTo(const Target& object, const Pose& T_map_object, bool include_supported = false);
  Edit& MoveBy(const Target& object, const Vector3& by_m, bool include_supported = false);
  /// About its middle, counterclockwise from above.
  Edit& Turn(const Target& object, double angle_rad, bool include_supported = false);
  /// Onto another object: over at_m, of which z does not count, or the middle of its upper side.
  Edit& Place(const Target& object, const Target& on, const std::optional<Vector3>& at_m = {},
              bool include_supported = false);

  Edit& Delete(const Target& object);
  Edit& Undelete(std::int64_t object);
  /// Another class of its kind.
  Edit& Relabel(const Target& object, std::string_view class_name);
  /// For people; "" follows the class again.
  Edit& Rename(const Target& object, std::string_view name);
  /// The others become parts of this thing.
  Edit& Merge(const Target& object, std::span<const std::int64_t> others);
  Edit& SetPresent(const Target& object, bool is_present);
  /// Mapping leaves it as it is.
  Edit& SetLocked(const Target& object, bool is_locked);
  /// Forgets what was observed there: of these classes, or of all.
  Edit& Clear(const Region& region, std::span<const std::string> class_names = {});
  /// From now on no frame puts anything there.
  Edit& IgnoreRegion(std::string_view name, const Region& region);
  Edit& UnignoreRegion(std::string_view name);

  // These make an object, which later edits of the list may name.
  /// A copy, where the original is unless a pose is given.
  NewObject Clone(const Target& object, const std::optional<Pose>& T_map_object = {}, std::string_view name = "");
  /// What lies in the box becomes an object; of stuff, class_name is that of the new thing.
  NewObject Split(const Target& object, const Box& box, std::string_view class_name = "");

  /// What the edits so far would do; changes nothing. Fails as Apply would.
  Result<Edited> Preview() const;
  /// Does them, and empties the list. Answered once they are stored. Sent again where it is not known whether the
  /// server has got it, under the same id, so that it is done once.
  Result<Edited> Apply();

 private:
  friend class Map;
  struct Impl;
  explicit Edit(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

struct UndoOptions {
  int count = 1;              ///< so many of the author's last edits
  std::int64_t revision = 0;  ///< not 0: that edit instead, whoever made it
  std::string author;         ///< empty: that of ConnectOptions
};

struct RestoreOptions {
  std::optional<std::int64_t> object;  ///< only this one
  std::string author;                  ///< empty: that of ConnectOptions
};

/// What undoing, doing again or restoring did: edits by their revisions, objects by their ids.
struct Undone {
  std::int64_t revision = 0;
  std::vector<std::int64_t> edits, changed, created, removed;
};

}  // namespace dhpmap::client
