// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "mapping/base/thread_pool.h"
#include "storage/postgres/connection.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// The present state of a map, for readers that never write it. Errors as MapStore::LoadMap.
Result<StateToRead> ReadState(Connection& connection, const std::string& name, ThreadPool& pool);

/// The present state of a map, made from `before` and the rows committed since, in at most six round trips. Nothing if
/// the database no longer keeps the places of all those commits, or if another map has the name now: load it again.
/// NOT_FOUND if there is no such map; DATA_LOSS.
Result<std::optional<StateToRead>> ReadLaterState(Connection& connection, const StateToRead& before, ThreadPool& pool);

}  // namespace dhpmap::postgres
