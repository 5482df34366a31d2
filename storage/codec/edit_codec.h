// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/changes/state_delta.h"
#include "mapping/map/edit_entry.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

// Blobs of the edit log and of undo data. See FORMAT.md.

/// All of `entry.summary` except its kind, which is a column. Sealed for the entry's revision.
Bytes EncodeEditSummary(const EditEntry& entry);
/// Inverse of EncodeEditSummary; `entry` has the revision. Errors as Unseal.
Status DecodeEditSummary(ByteView blob, EditEntry& entry);

/// All of a delta except its tiles. Sealed for the revision of the edit.
Bytes EncodeEditRows(const StateDelta& delta, std::int64_t revision);
/// Inverse of EncodeEditRows. Errors as Unseal.
Status DecodeEditRows(ByteView blob, std::int64_t revision, StateDelta& delta);

}  // namespace dhpmap
