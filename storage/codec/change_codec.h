// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/changes/map_change.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// What a commit changed, as bytes; see FORMAT.md. Exact.
Bytes EncodeChange(const MapChange& change);

/// `change` has the revisions and the time that the blob belongs to. DATA_LOSS for anything EncodeChange did not make
/// for that last revision, FAILED_PRECONDITION for a blob of a later version. Messages go on after "it".
Status DecodeChange(ByteView blob, MapChange& change);

}  // namespace dhpmap
