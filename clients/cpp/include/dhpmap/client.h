// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dhpmap/map.h"
#include "dhpmap/options.h"
#include "dhpmap/result.h"
#include "dhpmap/server.h"

namespace dhpmap::client {

struct NewMap {
  std::string title;           ///< for people
  std::vector<Label> classes;  ///< by which frames name classes; without any they may name none
  std::string preset;          ///< "indoor" (default) or "outdoor_lidar"
  double voxel_size_m = 0;     ///< 0, as of the next: that of the preset
  double truncation_m = 0;
};

/// A connection to a dhpmap-server. Copies share it. Safe for use from several threads. Maps that came from it stay
/// usable after it.
class Client {
 public:
  /// Waits for the server: Unavailable if none answers within connect_s. InvalidArgument for certificates that cannot
  /// be read, or a token that would go out in the clear.
  static Result<Client> Connect(const std::string& address = "127.0.0.1:50051", const ConnectOptions& options = {});

  /// NotFound, reason MAP_NOT_FOUND, with the names of the maps that there are.
  Result<Map> OpenMap(std::string_view name) const;
  /// All maps, by name.
  Result<std::vector<MapInfo>> Maps() const;
  /// A new, empty map. AlreadyExists; InvalidArgument with every field that is wrong. Never sent twice, as DeleteMap.
  Result<Map> CreateMap(std::string_view name, const NewMap& map = {}) const;
  /// How the server is. Unimplemented by one of 0.2.0 and before.
  Result<ServerStatus> GetStatus() const;
  /// Deletes a map with all that is in it. FailedPrecondition while it is fed, NotFound.
  Status DeleteMap(std::string_view name) const;
  /// A copy of the server's database with all maps, as committed.
  Result<FileInfo> Backup(const TakePart& take, double deadline_s = 3600) const;
  /// A map from a file that Map::Export has written; name "": that of the file. InvalidArgument for a file that cannot
  /// be read, AlreadyExists. Never sent twice.
  Result<Map> ImportMap(const std::string& file, std::string_view name = "", double deadline_s = 3600) const;

 private:
  explicit Client(std::shared_ptr<Caller> caller);

  std::shared_ptr<Caller> caller_;
};

}  // namespace dhpmap::client
