// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "storage/rows/class_rows.h"
#include "storage/rows/config_rows.h"
#include "storage/rows/map_row.h"

namespace dhpmap {

/// Version 1 of a map row's checksum, which covered config and classes directly: the stored keys, in the order of the
/// list of keys at that time. FAILED_PRECONDITION, reason NEWER_CONFIG, for a key that did not exist then.
Result<std::uint32_t> MapChecksumV1(const MapRow& row, const std::vector<ConfigRow>& config,
                                    const std::vector<ClassRow>& classes);

}  // namespace dhpmap
