// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "storage/postgres/connection.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// As MapStore::ListChanges.
Result<ChangeList> ReadChangeList(Connection& connection, const std::string& name, std::int64_t after_revision,
                                  std::size_t max_bytes);

}  // namespace dhpmap::postgres
