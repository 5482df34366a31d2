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
  std::string title;           ///< display name
  std::vector<Label> classes;  ///< that frames refer to; without any, frames must not refer to classes
  std::string preset;          ///< "indoor" (default) or "outdoor_lidar"
  double voxel_size_m = 0;     ///< 0 here and in the next field: that of the preset
  double truncation_m = 0;
};

/// A connection to a dhpmap-server. Copies share it. Thread-safe. Maps remain usable after the client is destroyed.
class Client {
 public:
  /// Waits for the server: Unavailable if none answers within connect_s. InvalidArgument for unreadable certificates,
  /// or a token that would be sent without TLS.
  static Result<Client> Connect(const std::string& address = "127.0.0.1:50051", const ConnectOptions& options = {});

  /// NotFound, reason MAP_NOT_FOUND, with the names of existing maps.
  Result<Map> OpenMap(std::string_view name) const;
  /// All maps, sorted by name.
  Result<std::vector<MapInfo>> Maps() const;
  /// Creates an empty map. AlreadyExists; InvalidArgument with every wrong field. Never retried; nor is DeleteMap.
  Result<Map> CreateMap(std::string_view name, const NewMap& map = {}) const;
  /// The server's status. Unimplemented in servers up to 0.2.0.
  Result<ServerStatus> GetStatus() const;
  /// Deletes a map and all its data. FailedPrecondition while it is fed; NotFound.
  Status DeleteMap(std::string_view name) const;
  /// Downloads a copy of the server's database with all maps, as committed.
  Result<FileInfo> Backup(const TakePart& take, double deadline_s = 3600) const;
  /// Creates a map from a file written by Map::Export; name "": that in the file. InvalidArgument for an unreadable
  /// file, AlreadyExists. Never retried.
  Result<Map> ImportMap(const std::string& file, std::string_view name = "", double deadline_s = 3600) const;

 private:
  explicit Client(std::shared_ptr<Caller> caller);

  std::shared_ptr<Caller> caller_;
};

}  // namespace dhpmap::client
