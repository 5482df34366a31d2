// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "storage/schema/schema_step.h"

namespace dhpmap {

/// The work of step 7: blobs of single blocks, one row each, become bundles (codec/block_bundle.h), and their tables
/// are dropped. Blobs are not decoded, so damaged ones stay as they are.
extern const SchemaWork kBundleBlocks;

}  // namespace dhpmap
