// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/reading/page_reader.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {

/// A transaction that reads one state. Ends with its scope.
class OneState {
 public:
  static Result<OneState> Begin(Connection& connection);
  OneState(OneState&& other) noexcept : connection_(std::exchange(other.connection_, nullptr)) {}
  OneState& operator=(OneState&&) = delete;
  ~OneState();

 private:
  explicit OneState(Connection& connection) : connection_(&connection) {}
  Connection* connection_;
};

/// The SELECTs of a map's parts by map_key ($1), in the order of MapParts, each ordered as checksums want it.
std::vector<Call> CallsForParts(std::int64_t map_key);
/// Answers to them. DATA_LOSS for a row that is none.
Result<MapParts> ReadParts(std::span<Answer> answers);

/// The whole map. Its tiles get keys of `store`. `pages`: where those of objects are left; null: they are read, too.
/// Errors as MapStore::LoadMap.
Result<std::shared_ptr<const MapSnapshot>> ReadMapState(Connection& connection, const std::string& name,
                                                        std::int64_t map_key, std::uint16_t store, ThreadPool& pool,
                                                        const std::shared_ptr<PageReader>& pages = nullptr);

}  // namespace dhpmap::postgres
