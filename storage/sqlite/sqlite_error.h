// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "mapping/base/status.h"

namespace dhpmap::sqlite {

/// The Status for an (extended) SQLite result code other than OK, ROW and DONE. `task` completes "cannot ..."; the
/// message holds neither SQL nor a path, so that it may go to clients.
Status ErrorFrom(int code, std::string_view task);

/// The same for a statement that is known to be correct: if SQLite rejects it (SQLITE_ERROR), a table or column is
/// missing, as in a file truncated while open. DATA_LOSS.
Status ErrorOfStatement(int code, std::string_view task);

}  // namespace dhpmap::sqlite
