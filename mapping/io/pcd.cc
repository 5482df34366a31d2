// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/pcd.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <cstring>
#include <exception>

namespace dhpmap {
namespace {

void AddField(const char* name, std::uint8_t datatype, std::uint32_t size_bytes, pcl::PCLPointCloud2& cloud) {
  pcl::PCLPointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = datatype;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += size_bytes;
}

pcl::PCLPointCloud2 ToCloud(const Mesh& mesh) {
  pcl::PCLPointCloud2 cloud;
  for (const char* name : {"x", "y", "z", "normal_x", "normal_y", "normal_z", "rgb"}) {
    AddField(name, pcl::PCLPointField::FLOAT32, 4, cloud);
  }
  AddField("class", pcl::PCLPointField::UINT16, 2, cloud);
  AddField("instance", pcl::PCLPointField::UINT32, 4, cloud);
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(mesh.vertices_m.size());
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(mesh.vertices_m.size() * cloud.point_step);
  std::uint8_t* out = cloud.data.data();
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i, out += cloud.point_step) {
    const Color color = mesh.colors[i];
    const std::uint32_t rgb = std::uint32_t{color.r} << 16 | std::uint32_t{color.g} << 8 | color.b;  // PCL's packing
    std::memcpy(out, mesh.vertices_m[i].data(), 12);
    std::memcpy(out + 12, mesh.normals[i].data(), 12);
    std::memcpy(out + 24, &rgb, 4);
    std::memcpy(out + 28, &mesh.classes[i], 2);
    std::memcpy(out + 30, &mesh.instances[i], 4);
  }
  return cloud;
}

}  // namespace

Result<std::string> WritePcd(const Mesh& mesh) {
  try {
    const pcl::PCLPointCloud2 cloud = ToCloud(mesh);
    // PCDWriter::writeBinary only writes to a file name; this is what it writes.
    std::string file =
        pcl::PCDWriter().generateHeaderBinary(cloud, Eigen::Vector4f::Zero(), Eigen::Quaternionf::Identity());
    file += "DATA binary\n";
    file.append(reinterpret_cast<const char*>(cloud.data.data()), cloud.data.size());
    return file;
  } catch (const std::exception& error) {
    return Internal(std::string("PCL cannot write the point cloud: ") + error.what());
  }
}

}  // namespace dhpmap
