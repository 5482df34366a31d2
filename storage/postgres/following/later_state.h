// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "mapping/base/thread_pool.h"
#include "storage/postgres/connection.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// A map as it is, for who will not write it. Errors as MapStore::LoadMap.
Result<StateToRead> ReadState(Connection& connection, const std::string& name, ThreadPool& pool);

/// The present state of the map of `before`, by what was committed since: in six round trips at most. Nothing if that
/// is more than is kept, or another map has the name now: to be read anew. NOT_FOUND if there is no such map;
/// DATA_LOSS.
Result<std::optional<StateToRead>> ReadLaterState(Connection& connection, const StateToRead& before, ThreadPool& pool);

}  // namespace dhpmap::postgres
