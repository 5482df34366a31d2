// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/changes/map_change.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// The change of a commit, as bytes; see FORMAT.md. Exact.
Bytes EncodeChange(const MapChange& change);

/// `change` has the revisions and the time of the blob. DATA_LOSS for anything that EncodeChange did not write for that
/// last revision, FAILED_PRECONDITION for a blob of a later version. Messages continue after "it".
Status DecodeChange(ByteView blob, MapChange& change);

}  // namespace dhpmap
