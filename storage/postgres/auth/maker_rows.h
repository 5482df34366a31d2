// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

// As AuthTables promises.
Status WriteMapMaker(Connection& connection, std::uint64_t history_id, const std::string& principal);
Result<std::optional<std::string>> ReadMakerOf(Connection& connection, std::uint64_t history_id);
Result<std::vector<std::uint64_t>> ReadMapsMadeBy(Connection& connection, const std::string& principal);
/// Deletes rows of maps that are gone.
Status ForgetMakersOfGoneMaps(Connection& connection);

}  // namespace dhpmap::postgres
