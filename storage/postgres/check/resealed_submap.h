// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "storage/postgres/check/rows_to_verify.h"
#include "storage/postgres/values.h"

namespace dhpmap::postgres {

/// The statements that update a submap's row, and the rows of its tiles, to its readable tiles, as of `revision`.
/// `rows`: the present rows, without unreadable ones.
Result<std::vector<Call>> ResealedSubmap(RowsToVerify& rows, const SubmapRow& row, std::int64_t revision);

}  // namespace dhpmap::postgres
