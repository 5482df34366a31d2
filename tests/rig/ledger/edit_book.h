// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/rig/ledger/progress.h"
#include "tests/rig/ledger/state_names.h"

namespace dhpmap::rig {

/// A submap of a history, or (of the history "maps") a map that only one client makes and deletes.
struct ObjectKey {
  std::string history;
  std::int64_t id = 0;
  auto operator<=>(const ObjectKey&) const = default;
};
std::string ToString(const ObjectKey& key);

enum class Presence { kEither, kThere, kGone };  ///< kEither: mapping may make it and take it away

/// What edits have asked for of an object; the rest is mapping's.
struct Wish {
  Presence presence = Presence::kEither;
  std::optional<std::string> display_name;
  std::optional<Eigen::Vector3d> position_m;
  std::optional<int> class_id;
};

/// An object as it was answered.
struct Sight {
  std::string display_name;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  int class_id = 0;
};

using EditId = std::int64_t;

struct EditPlan {
  std::string what;  ///< for people
  std::string history;
  std::optional<std::int64_t> id;  ///< nothing: of a copy that is to be made, known by its display name
  Wish change;                     ///< goes on top of what the object was asked to be before
  Wish before;                     ///< of an object that no edit has touched yet
  bool is_vain = false;            ///< its etag is not the present one: it cannot be made
};

/// Law 3: an edit that was made is there, one that was refused is not, one whose answer was cut off is there or not, as
/// a whole, and stays so. Of a list of edits all are there or none. Display names that begin with kMark are given by
/// edits of the rig alone, each once. Thread-compatible.
class EditBook {
 public:
  static constexpr const char* kMark = "rig-";

  explicit EditBook(Complaints& complaints) : complaints_(complaints) {}

  /// Nothing if another edit of the object is under way.
  std::optional<EditId> Begin(EditPlan plan, Moment begun);
  /// Edits of one history that are made together, at most one of an object. Nothing if one of them cannot begin, or its
  /// object is none of which it can always be told whether it was changed: see IsHeld.
  std::optional<std::vector<EditId>> BeginList(std::vector<EditPlan> plans, Moment begun);
  /// Takes back what these edits, which were made together, have changed, or does it again; all else of their objects
  /// stays. Nothing as above, or if it would change nothing that can be told.
  std::optional<std::vector<EditId>> BeginUndo(const std::vector<EditId>& made, bool is_redo, const std::string& what,
                                               Moment begun);
  /// Whether edits alone have made the object, named it and may take it away, and none is under way: mapping leaves it
  /// alone.
  [[nodiscard]] bool IsHeld(const ObjectKey& key) const;

  [[nodiscard]] const std::string& HistoryOf(EditId edit) const { return edits_.at(edit).plan.history; }

  /// `id` and `sight`: what the answer says of the object, if it says anything.
  void OnMade(EditId edit, std::optional<std::int64_t> id, const Sight* sight, Moment answered);
  void OnRefused(EditId edit);
  /// Stays open until OnRestarted.
  void OnCut(EditId edit) { edits_.at(edit).is_cut = true; }

  void OnSeen(const ObjectKey& key, const Sight& sight, Moment asked, Moment answered);
  void OnAbsent(const ObjectKey& key, Moment asked, Moment answered);
  /// Everything that there is of a history.
  void OnWhole(const std::string& history, const std::map<std::int64_t, Sight>& sights, Moment asked, Moment answered);
  /// The same, first after a restart: it decides what was cut. Returns how many of those edits were made.
  int OnRestarted(const std::string& history, const std::map<std::int64_t, Sight>& sights, Moment asked,
                  Moment answered);

  /// Whether somebody had been told by then that it is gone.
  [[nodiscard]] bool IsGone(const ObjectKey& key, Moment moment) const;

 private:
  struct Version {
    Wish wish;
    Moment begun = 0;
    std::optional<Moment> made;  ///< nothing: under way, or cut
    EditId edit = 0;             ///< 0: how the object was before any
  };
  struct Edit {
    EditPlan plan;
    Moment begun = 0;
    std::optional<ObjectKey> key;
    bool is_cut = false, is_seen = false, is_over = false, was_made = false;
  };
  using Versions = std::vector<Version>;
  struct List {
    std::vector<EditId> edits;
    bool is_told = false;  ///< that it is there in part; one complaint each
  };

  [[nodiscard]] static bool Allows(const Wish& wish, const Sight* sight);
  EditId Enter(EditPlan plan, Wish wish, Moment begun);
  std::optional<Wish> WishAfter(EditId made, bool is_redo) const;
  void CheckLists(const std::string& history, const std::map<std::int64_t, Sight>& sights, Moment asked);
  std::optional<bool> Shows(EditId edit, const std::map<std::int64_t, Sight>& sights, Moment asked) const;
  Versions& VersionsOf(const ObjectKey& key, const Wish& before);
  void Adopt(EditId edit, const ObjectKey& key);
  bool MayHaveItsName(const ObjectKey& key, const Sight& sight);
  void Check(const ObjectKey& key, const Sight* sight, Moment asked, Moment answered);
  void Decide(EditId edit, bool was_made, Moment moment);

  Complaints& complaints_;
  std::map<EditId, Edit> edits_;
  std::map<ObjectKey, Versions> objects_;
  std::map<std::string, EditId> names_;
  std::vector<List> open_lists_;
};

}  // namespace dhpmap::rig
