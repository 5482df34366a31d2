// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"
#include "mapping/map/label_block.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// Encodes a label block without loss, and the same counts always as the same bytes. Id 0 of an instance list stays
/// "the submap that holds this voxel". `index` goes into the checksum. Thread-safe.
Bytes EncodeLabelBlock(const LabelBlock& block, BlockIndex index);

/// Fills `block`, whatever it held. Errors as Unseal.
Status DecodeLabelBlock(ByteView blob, BlockIndex index, LabelBlock& block);

}  // namespace dhpmap
