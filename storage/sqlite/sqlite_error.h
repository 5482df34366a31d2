// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "mapping/base/status.h"

namespace dhpmap::sqlite {

/// The Status for an (extended) SQLite result code other than OK, ROW and DONE. `task` completes "cannot ..."; the
/// message holds neither SQL nor a path, so that it may go to clients.
Status ErrorFrom(int code, std::string_view task);

/// The same for one that a statement gives which is right as far as tests can tell: what SQLite finds wrong with it
/// (SQLITE_ERROR) is that a table or column is not there, as in a file that was cut off while it was open. DATA_LOSS.
Status ErrorOfStatement(int code, std::string_view task);

}  // namespace dhpmap::sqlite
