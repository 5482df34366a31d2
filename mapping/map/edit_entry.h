// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/base/ids.h"

namespace dhpmap {

// What the log of a map's edits says of one. Kept by the store, so numbers are never reused.

enum class EditKind : std::uint8_t { kEdit = 0, kUndo = 1, kRedo = 2 };

/// What was asked for.
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

/// One thing that was asked for, and of which object; kUnknownSubmap: of none in particular.
struct EditStep {
  EditAction action = EditAction::kMove;
  SubmapId submap;
  friend bool operator==(const EditStep&, const EditStep&) = default;
};

/// What an edit did.
struct EditSummary {
  EditKind kind = EditKind::kEdit;
  std::vector<EditStep> steps;
  std::vector<std::int64_t> targets;  ///< of kUndo and kRedo: the edits that it undid or did again, in that order
  // In ascending order, each once.
  std::vector<SubmapId> changed;
  std::vector<SubmapId> created;
  std::vector<SubmapId> removed;
  std::int64_t num_voxels = 0;  ///< that changed hands, or were cleared
  /// Of kRestore: back to which; 0: not told, as of those that were made before the log told it.
  std::int64_t restored_revision = 0;
  friend bool operator==(const EditSummary&, const EditSummary&) = default;
};

/// Who asks for an edit, and in which request.
struct EditSource {
  std::string author;      ///< empty: nobody in particular
  std::string request_id;  ///< empty: its client does not repeat it
  /// Tells requests apart that have the same id; see Fingerprint.
  std::uint64_t request_fingerprint = 0;
  friend bool operator==(const EditSource&, const EditSource&) = default;
};

/// A row of the log. An edit is known by the revision that has it.
struct EditEntry {
  std::int64_t revision = 0;
  std::int64_t time_ns = 0;  ///< UTC
  EditSource source;
  EditSummary summary;
};

}  // namespace dhpmap
