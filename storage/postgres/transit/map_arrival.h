// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "storage/files/map_file_rows.h"
#include "storage/files/map_taker.h"
#include "storage/postgres/pool.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/postgres/transit/incoming_map.h"

namespace dhpmap::postgres {

/// Imports the map of a file. First writes all rows under a key without a name, in steps of a megabyte; then adds the
/// name and the map's own row in one transaction. Commits of other maps never wait for it. Rows of an unfinished import
/// are swept by this process or the next. Needs memory for one step, and 20 bytes a blob. Thread-compatible.
class MapArrival final : public MapTaker {
 public:
  /// `pool` outlives it. `on_abandoned` is called if rows are left to sweep.
  MapArrival(MapFile file, Pool& pool, ConnectionOptions options, std::function<void()> on_abandoned)
      : file_(std::move(file)), pool_(pool), options_(std::move(options)), on_abandoned_(std::move(on_abandoned)) {}
  ~MapArrival() override;
  MapArrival(const MapArrival&) = delete;
  MapArrival& operator=(const MapArrival&) = delete;

  Status Bring(const std::stop_token& stop) override;
  Status Add(const std::string& name) override;

 private:
  Status BringBlobs(const std::stop_token& stop);
  Status BringTiles(FileHead& from, const std::stop_token& stop);
  Result<TileTotals> CopyTiles(FileTiles& tiles, std::int64_t from_owner_key, std::int64_t owner_id);
  Status BringCounts();
  void PrepareHead(const FileHead& from, const TileTotals& own_tiles);
  /// Runs one step as a transaction, again if its answer was lost: rows that already exist stay.
  Status Write(std::vector<Call>& calls);
  Status WriteIfMany(std::vector<Call>& calls);

  MapFile file_;
  Pool& pool_;
  const ConnectionOptions options_;
  const std::function<void()> on_abandoned_;
  std::optional<IncomingMap> incoming_;
  BlobKeys blobs_;                       ///< in the file; the database numbers them from 1
  std::vector<BroughtSize> sizes_;       ///< of each imported blob
  std::vector<std::uint32_t> num_uses_;  ///< number of tiles that use each blob
  std::vector<Call> waiting_;            ///< statements of the next step
  MapHead head_;
};

}  // namespace dhpmap::postgres
