// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "storage/postgres/check/rows_to_verify.h"
#include "storage/postgres/values.h"

namespace dhpmap::postgres {

/// The statements that have the row of a submap, and those of its tiles, say what can be read of it, as of `revision`.
/// `rows`: as they are now, without unreadable ones.
Result<std::vector<Call>> ResealedSubmap(RowsToVerify& rows, const SubmapRow& row, std::int64_t revision);

}  // namespace dhpmap::postgres
