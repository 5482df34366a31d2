// SPDX-License-Identifier: BSD-3-Clause
#include "tests/e2e/same_maps.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <utility>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"

namespace dhpmap::testing {

v1::Map GetMap(const ServerProcess& server, const std::string& map) {
  grpc::ClientContext context;
  v1::GetMapRequest request;
  request.set_name("maps/" + map);
  v1::GetMapResponse response;
  const grpc::Status status = v1::MapService::NewStub(server.Connect())->GetMap(&context, request, &response);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return response.map();
}

namespace {

/// Voxels by position, of every submap.
using Voxels = std::map<std::array<float, 3>, std::pair<float, std::uint32_t>>;
std::map<std::int64_t, Voxels> AllVoxels(const ServerProcess& server, const std::string& map) {
  const auto stub = v1::SubmapService::NewStub(server.Connect());
  grpc::ClientContext list_context;
  v1::ListSubmapsRequest list;
  list.set_parent("maps/" + map);
  v1::ListSubmapsResponse submaps;
  EXPECT_TRUE(stub->ListSubmaps(&list_context, list, &submaps).ok());
  std::map<std::int64_t, Voxels> all;
  for (const v1::Submap& submap : submaps.submaps()) {
    grpc::ClientContext context;
    v1::StreamSubmapVoxelsRequest request;
    request.set_name(submap.name());
    const auto stream = stub->StreamSubmapVoxels(&context, request);
    Voxels& voxels = all[submap.instance_id()];
    for (v1::StreamSubmapVoxelsResponse part; stream->Read(&part);) {
      for (int i = 0; i < part.tsdf_m_size(); ++i) {
        voxels[{part.xyz_m(3 * i), part.xyz_m(3 * i + 1), part.xyz_m(3 * i + 2)}] = {part.tsdf_m(i), part.class_id(i)};
      }
    }
    EXPECT_TRUE(stream->Finish().ok());
  }
  return all;
}

}  // namespace

void ExpectSameMaps(const ServerProcess& server, const std::string& a, const std::string& b) {
  const auto voxels_a = AllVoxels(server, a), voxels_b = AllVoxels(server, b);
  ASSERT_EQ(voxels_a.size(), voxels_b.size());
  const float bound_m = static_cast<float>(GetMap(server, a).config().truncation_m() / 4096) + 1e-6f;  // of the codec
  for (const auto& [id, submap] : voxels_a) {
    SCOPED_TRACE("submap " + std::to_string(id));
    ASSERT_TRUE(voxels_b.contains(id));
    const Voxels& other = voxels_b.at(id);
    ASSERT_EQ(submap.size(), other.size());
    for (const auto& [position, voxel] : submap) {
      const auto it = other.find(position);
      ASSERT_NE(it, other.end());
      ASSERT_NEAR(voxel.first, it->second.first, bound_m);
      ASSERT_EQ(voxel.second, it->second.second);
    }
  }
}

}  // namespace dhpmap::testing
