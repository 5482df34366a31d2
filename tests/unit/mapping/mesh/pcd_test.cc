// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/pcd.h"

#include <gtest/gtest.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <cstring>
#include <fstream>

#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

pcl::PCLPointCloud2 ReadWithPcl(const std::string& file) {
  const testing::TempDir dir;
  const std::string path = (dir.path() / "cloud.pcd").string();
  std::ofstream(path, std::ios::binary) << file;
  pcl::PCLPointCloud2 cloud;
  EXPECT_EQ(pcl::PCDReader().read(path, cloud), 0);
  return cloud;
}

template <typename T>
T Value(const pcl::PCLPointCloud2& cloud, std::size_t point, const std::string& field_name) {
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name != field_name) continue;
    T value;
    std::memcpy(&value, &cloud.data[point * cloud.point_step + field.offset], sizeof value);
    return value;
  }
  ADD_FAILURE() << "no field " << field_name;
  return {};
}

TEST(WritePcd, PclReadsBackEveryField) {
  Mesh mesh;
  for (int i = 0; i < 100; ++i) {
    mesh.vertices_m.emplace_back(0.1f * i, -1.5f, 1e4f + i);
    mesh.normals.emplace_back(0.0f, 0.6f, -0.8f);
    mesh.colors.push_back({static_cast<std::uint8_t>(i), 250, 3});
    mesh.classes.push_back(static_cast<std::uint16_t>(65'000 + i));
    mesh.instances.push_back(3'000'000'000u + static_cast<std::uint32_t>(i));
  }
  const auto file = WritePcd(mesh);
  ASSERT_TRUE(file.ok()) << file.status().ToString();
  const pcl::PCLPointCloud2 cloud = ReadWithPcl(*file);
  ASSERT_EQ(cloud.width * cloud.height, 100u);
  EXPECT_EQ(cloud.fields.size(), 9u);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(Value<float>(cloud, i, "x"), mesh.vertices_m[i].x());
    EXPECT_EQ(Value<float>(cloud, i, "y"), mesh.vertices_m[i].y());
    EXPECT_EQ(Value<float>(cloud, i, "z"), mesh.vertices_m[i].z());
    EXPECT_EQ(Value<float>(cloud, i, "normal_x"), 0.0f);
    EXPECT_EQ(Value<float>(cloud, i, "normal_y"), 0.6f);
    EXPECT_EQ(Value<float>(cloud, i, "normal_z"), -0.8f);
    EXPECT_EQ(Value<std::uint32_t>(cloud, i, "rgb"), i << 16 | 250u << 8 | 3u);
    EXPECT_EQ(Value<std::uint16_t>(cloud, i, "class"), mesh.classes[i]);
    EXPECT_EQ(Value<std::uint32_t>(cloud, i, "instance"), mesh.instances[i]);
  }
}

TEST(WritePcd, EmptyMeshIsACloudWithoutPoints) {
  const auto file = WritePcd(Mesh());
  ASSERT_TRUE(file.ok()) << file.status().ToString();
  EXPECT_NE(file->find("POINTS 0\n"), std::string::npos);
  EXPECT_TRUE(file->ends_with("DATA binary\n"));
}

}  // namespace
}  // namespace dhpmap
