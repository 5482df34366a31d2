// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "mapping/base/mutex.h"
#include "tests/rig/ledger/edit_book.h"
#include "tests/rig/ledger/progress.h"
#include "tests/rig/ledger/state_names.h"

namespace dhpmap::rig {

/// What an etag that was read names.
struct NamedState {
  ObjectKey submap;
  std::int64_t revision = 0;
  std::int64_t edited_revision = 0;  ///< of its last edit or merge by then
};
/// What the etag of a submap names. Clients need not know how; the ledger does, so that it sees more than they.
NamedState StateOf(const std::string& history, const v1::Submap& submap);

/// An edit of a submap, with what its etag names if it gives one: of a copy, that is a state of the original.
struct SubmapEdit {
  EditPlan plan;
  std::optional<NamedState> etag;
};

/// How much was told, asked and decided.
struct Tally {
  std::int64_t num_answers = 0, num_listings = 0;
  std::int64_t num_edits_made = 0, num_edits_refused = 0, num_edits_cut = 0, num_cut_edits_made = 0;
  std::int64_t num_lists_made = 0, num_lists_refused = 0, num_lists_cut = 0;  ///< undos included
  std::int64_t num_undone = 0;                                                ///< of them; done again included
  std::int64_t num_backups = 0;
  std::int64_t num_stale_edits = 0;  ///< with an etag that was certainly not the present one
  std::int64_t num_names = 0;        ///< etags, revisions and listings, each with its state
  std::int64_t num_sequences_told = 0, num_resumed = 0;
  std::int64_t num_lost_tokens_asked = 0, num_good_tokens_asked = 0;
};

/// What clients of a server were told, over all of its lives on one database, and what that forbids:
///   1. A name of a state (an etag of a submap, a revision in a history) is never that of another state, and an id of a
///      submap never that of another object of its history, whether or not the state was ever stored.
///   2. A map's revision never goes back within a history. What names a state that was lost is refused as HISTORY_LOST;
///      what names one that was stored is not.
///   3. An edit that was answered OK is there, one that was answered with an error is not; one whose answer was cut off
///   is
///      there or not, as a whole, and stays so. Edits of one list are all there or none, in every state; an undo is the
///      list that takes back what another has changed.
///   4. What a session was told is stored is stored, and a map has exactly the frames that its sessions have stored.
///   5. An edit with an etag of before another edit or merge, of another history or of a lost state is never made. What
///      frames have changed since does not matter.
///   6. A backup that was finished has what was told before it was begun: edits that were made, frames that are stored.
/// Every answer of a kind below is handed in, with the moment before its question was sent. Thread-safe.
class Ledger {
 public:
  Moment Now();

  void OnMap(const v1::Map& map, Moment asked);
  void OnSubmap(const std::string& history, const v1::Submap& submap, std::int64_t map_revision, Moment asked);
  void OnNoSubmap(const std::string& history, std::int64_t id, Moment asked);
  /// A page that has all submaps of its map.
  void OnListing(const std::string& history, const v1::ListSubmapsResponse& all, Moment asked);
  /// What the voxels of a submap are, in the state that its etag names.
  void OnVoxels(const std::string& history, const v1::Submap& state, const std::string& voxels);
  void OnRevision(const std::string& history, std::int64_t revision, Moment asked);
  /// Mapping was finished: that revision is stored.
  void OnFinished(const std::string& history, std::int64_t revision, Moment asked);

  void OnPageToken(const std::string& history, const std::string& token, std::int64_t revision);
  /// A token of before the last restart to ask with; `any` chooses.
  std::optional<KeptToken> TokenToAsk(const std::string& history, std::uint64_t any);
  void OnPage(const std::string& history, const KeptToken& token, bool is_refused_as_lost, const std::string& answer);

  void OnStored(const std::string& history, const std::string& session, std::int64_t sequence);
  void OnResumed(const std::string& history, const std::string& session, std::optional<std::int64_t> sequence,
                 std::int64_t num_frames);

  /// Nothing if another edit of the object is under way.
  std::optional<EditId> BeginEdit(SubmapEdit edit);
  void OnMade(EditId edit, const v1::Submap* after, std::int64_t map_revision);
  void OnRefused(EditId edit);
  void OnCut(EditId edit);

  /// Edits that are made together. Nothing as EditBook::BeginList says.
  std::optional<std::vector<EditId>> BeginList(std::vector<SubmapEdit> list);
  /// Nothing as EditBook::BeginUndo says.
  std::optional<std::vector<EditId>> BeginUndo(const std::vector<EditId>& made, bool is_redo);
  /// `ids`: for each edit, that of the copy that it made, if it did.
  void OnListMade(const std::vector<EditId>& list, const std::vector<std::optional<std::int64_t>>& ids,
                  std::int64_t map_revision);
  void OnListRefused(const std::vector<EditId>& list);
  void OnListCut(const std::vector<EditId>& list);
  /// Of objects that lists are made of: see EditBook::IsHeld.
  [[nodiscard]] bool IsHeld(const std::string& history, std::int64_t id) const;

  // Maps that only one client makes and deletes. `number` stands for the name.
  std::optional<EditId> BeginMapEdit(std::int64_t number, std::string what, Wish change, bool is_stale);
  void OnMapMade(EditId edit, const v1::Map* after);
  void OnSeenMap(std::int64_t number, const v1::Map* map, Moment asked);

  /// What is there first after a restart: what was cut off is decided by it.
  void OnRestarted(const v1::Map& map, const v1::ListSubmapsResponse& all, Moment asked);
  void OnMapsRestarted(const std::map<std::int64_t, v1::Map>& maps, Moment asked);

  /// How many frames of the history somebody was told are stored.
  [[nodiscard]] std::int64_t NumStoredFrames(const std::string& history);
  /// What a backup has of the map, which was asked for and was whole at these moments. `num_stored`: NumStoredFrames
  /// before it was asked for.
  void OnBackup(const std::string& history, const v1::Map& map, const v1::ListSubmapsResponse& all,
                std::int64_t num_stored, Moment asked, Moment answered);

  void Complain(std::string text);
  [[nodiscard]] Complaints complaints() const;
  [[nodiscard]] Tally tally() const;

 private:
  struct Pending {
    std::string what, history;
    Moment begun = 0;
    bool is_stale = false;
  };
  /// Which of a submap's states may be the present one. A crash takes it back to the one that is stored.
  struct Present {
    Floor newest_edit;                              ///< its edited_revision, told since the last restart
    std::int64_t stored = Floor::kNothing;          ///< its revision at the last restart; nothing: it was not there
    std::int64_t map_at_restart = Floor::kNothing;  ///< its map's then: what was told before is not beyond
  };
  bool IsStale(const NamedState& etag, const std::string& history) DHPMAP_REQUIRES(mutex_);
  Progress& ProgressOf(const std::string& history) DHPMAP_REQUIRES(mutex_);
  void See(const std::string& history, const v1::Submap& submap, std::int64_t map_revision, Moment asked)
      DHPMAP_REQUIRES(mutex_);
  void SeeListing(const std::string& history, const v1::ListSubmapsResponse& all, Moment asked) DHPMAP_REQUIRES(mutex_);
  void SeeMap(const v1::Map& map, Moment asked) DHPMAP_REQUIRES(mutex_);
  EditId Pend(EditId edit, Pending pending) DHPMAP_REQUIRES(mutex_);
  Pending Settle(EditId edit) DHPMAP_REQUIRES(mutex_);
  void PendAll(const std::vector<EditId>& list, const Pending& pending) DHPMAP_REQUIRES(mutex_);

  mutable Mutex mutex_;
  Moment now_ DHPMAP_GUARDED_BY(mutex_) = 0;
  Complaints complaints_ DHPMAP_GUARDED_BY(mutex_);
  Tally tally_ DHPMAP_GUARDED_BY(mutex_);
  StateNames names_ DHPMAP_GUARDED_BY(mutex_){complaints_};
  EditBook book_ DHPMAP_GUARDED_BY(mutex_){complaints_};
  std::map<std::string, Progress> progress_ DHPMAP_GUARDED_BY(mutex_);
  std::map<ObjectKey, Present> present_ DHPMAP_GUARDED_BY(mutex_);
  std::map<EditId, Pending> pending_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::rig
