// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/changes/state_marks.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// Limits of the maps' logs, and when unused blobs are deleted.
struct KeepingLimits {
  ChangeHistoryLimits changes = {};
  EditLogLimits edits = {};
  double dead_grace_s = 600;  ///< unused blobs stay this long, for readers of older states
};

/// A commit: the states before and after it, and the edit that made it (null: frames did).
struct CommitRequest {
  const StateMarks& before;
  const MapSnapshot& after;
  const EditRecord* edit = nullptr;
};

}  // namespace dhpmap::postgres
