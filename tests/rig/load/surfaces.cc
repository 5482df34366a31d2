// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/load/surfaces.h"

#include <algorithm>
#include <cmath>

#include "dhpmap/v1/submap_service.grpc.pb.h"

namespace dhpmap::rig {
namespace {

grpc::Status ReadSurfaceVoxels(v1::SubmapService::Stub& stub, ThingSurface& thing, MapSurfaces& map) {
  v1::StreamSubmapVoxelsRequest request;
  request.set_name(thing.submap.name());
  grpc::ClientContext context;
  const auto stream = stub.StreamSubmapVoxels(&context, request);
  const double voxel_size_m = thing.submap.voxel_size_m();
  v1::StreamSubmapVoxelsResponse part;
  while (stream->Read(&part)) {
    map.num_observed_voxels += part.tsdf_m_size();
    for (int i = 0; i < part.tsdf_m_size(); ++i) {
      if (std::abs(part.tsdf_m(i)) > voxel_size_m) continue;
      ++map.num_surface_voxels;
      std::array<std::int32_t, 3> voxel{};
      for (int axis = 0; axis < 3; ++axis) {
        const double voxels = std::floor(part.xyz_m(3 * i + axis) / voxel_size_m);
        voxel[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(voxels);
      }
      thing.voxels.insert(voxel);
    }
  }
  return stream->Finish();
}

}  // namespace

grpc::Status ReadSurfaces(const std::shared_ptr<grpc::Channel>& channel, const std::string& map_id, MapSurfaces& map) {
  const auto stub = v1::SubmapService::NewStub(channel);
  v1::ListSubmapsRequest request;
  request.set_parent("maps/" + map_id);
  do {
    grpc::ClientContext context;
    v1::ListSubmapsResponse page;
    grpc::Status listed = stub->ListSubmaps(&context, request, &page);
    if (!listed.ok()) return listed;
    for (const v1::Submap& submap : page.submaps()) {
      ThingSurface surface{.submap = submap, .voxels = {}};
      grpc::Status read = ReadSurfaceVoxels(*stub, surface, map);
      if (!read.ok()) return read;
      const bool is_thing = submap.kind() == v1::LabelClass::THING && submap.instance_id() != 0;
      if (is_thing && submap.presence() != v1::Submap::ABSENT) map.things.push_back(std::move(surface));
    }
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return grpc::Status::OK;
}

bool AreCounterparts(const ThingSurface& a, const ThingSurface& b) {
  if (a.submap.class_id() != b.submap.class_id()) return false;
  const ThingSurface& smaller = a.voxels.size() <= b.voxels.size() ? a : b;
  const ThingSurface& larger = &smaller == &a ? b : a;
  if (smaller.voxels.empty()) return false;
  const auto num_shared = std::count_if(smaller.voxels.begin(), smaller.voxels.end(),
                                        [&](const auto& voxel) { return larger.voxels.contains(voxel); });
  return 2 * static_cast<std::size_t>(num_shared) >= smaller.voxels.size();
}

}  // namespace dhpmap::rig
