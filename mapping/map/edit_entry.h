// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/base/ids.h"

namespace dhpmap {

// The log of a map's edits. Stored, so numbers are never reused.

enum class EditKind : std::uint8_t { kEdit = 0, kUndo = 1, kRedo = 2 };

/// The requested action.
enum class EditAction : std::uint8_t {
  kMove = 1,
  kRelabel = 2,
  kRename = 3,
  kClone = 4,
  kDelete = 5,
  kMerge = 6,
  kSplit = 7,
  kClear = 8,
  kSetPresence = 9,
  kRenameMap = 10,
  kUndelete = 11,
  kLock = 12,
  kUnlock = 13,
  kKeepClear = 14,
  kLift = 15,
  kRestore = 16,
};

/// One requested action and its object; kUnknownSubmap if it concerns none.
struct EditStep {
  EditAction action = EditAction::kMove;
  SubmapId submap;
  friend bool operator==(const EditStep&, const EditStep&) = default;
};

/// The effect of an edit.
struct EditSummary {
  EditKind kind = EditKind::kEdit;
  std::vector<EditStep> steps;
  std::vector<std::int64_t> targets;  ///< of kUndo and kRedo: the edits that were undone or redone, in that order
  // Ascending, without duplicates.
  std::vector<SubmapId> changed;
  std::vector<SubmapId> created;
  std::vector<SubmapId> removed;
  std::int64_t num_voxels = 0;  ///< voxels that moved between submaps or were cleared
  /// Of kRestore: the restored revision; 0 in logs that do not have it yet.
  std::int64_t restored_revision = 0;
  friend bool operator==(const EditSummary&, const EditSummary&) = default;
};

/// Author and request of an edit.
struct EditSource {
  std::string author;      ///< may be empty
  std::string request_id;  ///< empty: the client does not retry
  /// Distinguishes requests with the same id; see Fingerprint.
  std::uint64_t request_fingerprint = 0;
  friend bool operator==(const EditSource&, const EditSource&) = default;
};

/// A row of the log, identified by the revision of the edit.
struct EditEntry {
  std::int64_t revision = 0;
  std::int64_t time_ns = 0;  ///< UTC
  EditSource source;
  EditSummary summary;
};

}  // namespace dhpmap
