// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/changes/state_marks.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// What bounds the logs of maps, and what is deleted when.
struct KeepingLimits {
  ChangeHistoryLimits changes = {};
  EditLogLimits edits = {};
  double dead_grace_s = 600;  ///< blobs that nobody refers to stay so long, for who still reads an old state
};

/// A commit: its two states, and the edit that made the second (null: none).
struct CommitRequest {
  const StateMarks& before;
  const MapSnapshot& after;
  const EditRecord* edit = nullptr;
};

}  // namespace dhpmap::postgres
