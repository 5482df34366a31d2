// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "storage/schema/schema_step.h"

namespace dhpmap {

/// The work of step 7: the blobs of blocks, which were a row each, become tiles of blobs (codec/block_bundle.h), and
/// their tables go. None is decoded, so a damaged one stays as damaged as it was.
extern const SchemaWork kBundleBlocks;

}  // namespace dhpmap
