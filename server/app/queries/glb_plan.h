// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/base/spread.h"
#include "mapping/mesh/mesh_sources.h"
#include "server/app/queries/glb_cache.h"
#include "server/app/queries/mesh_request.h"

namespace dhpmap {

/// A GLB file that is wanted: what it shows and what it costs are known before any of it is made or read. Refers to the
/// map. Throws StatusError where what is on the disk cannot be read. Immutable.
class GlbPlan {
 public:
  GlbPlan(const MapSnapshot& map, const MeshRequest& request);

  /// Of what decides about its bytes (the tiles with voxels of it and of what is around, see PartId; poses where they
  /// are in the file): in this process, files of one name are the same. 0: it is not worth keeping.
  [[nodiscard]] std::uint64_t name() const { return name_; }
  /// Of the objects that it shows and of those around them, as of their last changes: the same in every process, so
  /// that who has the file of before a restart is told so before it is made. It changes oftener than name(). 0: none.
  [[nodiscard]] std::uint64_t state_name() const { return state_name_; }
  /// What making it takes beside the map, more or less.
  [[nodiscard]] std::size_t num_bytes() const { return num_bytes_; }

  /// Reads what it needs by `spread`, and makes it on one core. Null after a `stop` requested meanwhile.
  [[nodiscard]] std::shared_ptr<const GlbFile> Make(const std::stop_token& stop, const Spread& spread) const;

 private:
  [[nodiscard]] std::uint64_t NameOf() const;
  [[nodiscard]] std::uint64_t StateNameOf() const;
  void AppendWanted(std::string& text) const;
  [[nodiscard]] std::size_t BytesOf() const;

  const MapSnapshot& map_;
  const MeshRequest request_;
  const std::vector<const Submap*> wanted_;
  const MeshSources sources_;
  const std::uint64_t name_;
  const std::uint64_t state_name_;
  const std::size_t num_bytes_;
};

}  // namespace dhpmap
