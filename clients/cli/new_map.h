// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "clients/cli/connection.h"
#include "clients/cli/query_flags.h"
#include "clients/datasets/dataset.h"
#include "dhpmap/v1/map_service.pb.h"

namespace dhpmap {

/// Options of a map to be created.
struct NewMap {
  std::string name, display_name, preset;
  std::vector<std::string> settings;  ///< key=value
};
void AddNewMapOptions(CLI::App& command, NewMap& map);

/// The request for `map`, with the preset and classes of `dataset` unless that is null.
Result<v1::CreateMapRequest> ToRequest(const NewMap& map, const Dataset* dataset);

/// In the state that `read` says.
client::Result<v1::Map> GetMap(const Session& session, const std::string& name, const ReadFlags& read = {});

/// Creates the map unless it exists. An existing map must have the data set's classes, and takes no settings.
ExitCode EnsureMap(const Session& session, const NewMap& map, const Dataset& dataset);

}  // namespace dhpmap
