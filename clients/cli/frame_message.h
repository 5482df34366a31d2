// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "clients/datasets/dataset.h"
#include "dhpmap/v1/mapping_service.pb.h"

namespace dhpmap {

/// Converts a data set's frame to a message; image files are passed on without decoding.
v1::Frame ToMessage(const DatasetFrame& frame, bool has_persistent_ids);

}  // namespace dhpmap
