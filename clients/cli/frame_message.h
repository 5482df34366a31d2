// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "clients/datasets/dataset.h"
#include "dhpmap/v1/mapping_service.pb.h"

namespace dhpmap {

/// A data set's frame as the server takes it; image files are passed on unread.
v1::Frame ToMessage(const DatasetFrame& frame, bool has_persistent_ids);

}  // namespace dhpmap
