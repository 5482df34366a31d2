// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "mapping/base/result.h"
#include "storage/files/map_file.h"

namespace dhpmap {

/// Takes the map of a file into a store, without what an import has looked at already. Each store has its own. The
/// destructor leaves nothing of an unfinished one that will not be collected. Thread-compatible.
class MapTaker {
 public:
  virtual ~MapTaker() = default;
  /// As MapImport::Bring.
  virtual Status Bring(const std::stop_token& stop) = 0;
  /// As MapImport::Add, with a valid name.
  virtual Status Add(const std::string& name) = 0;
};

using MakeTaker = std::function<std::unique_ptr<MapTaker>(MapFile file)>;

}  // namespace dhpmap
