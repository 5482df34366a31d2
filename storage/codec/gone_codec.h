// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/map/gone_block.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// What was looked through of a block as a blob, see FORMAT.md. Equal blocks give equal bytes. `block` is not empty.
Bytes EncodeGoneBlock(const GoneBlock& block, BlockIndex index);

/// The block exactly as it was encoded. DATA_LOSS for anything that EncodeGoneBlock did not make for this index,
/// FAILED_PRECONDITION for a later version of it. Messages go on after "it".
Status DecodeGoneBlock(ByteView blob, BlockIndex index, GoneBlock& block);

}  // namespace dhpmap
