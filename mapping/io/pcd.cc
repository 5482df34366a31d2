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

constexpr std::size_t kPointBytes = 34;

/// Without its points.
pcl::PCLPointCloud2 EmptyCloud(std::size_t num_points) {
  pcl::PCLPointCloud2 cloud;
  for (const char* name : {"x", "y", "z", "normal_x", "normal_y", "normal_z", "rgb"}) {
    AddField(name, pcl::PCLPointField::FLOAT32, 4, cloud);
  }
  AddField("class", pcl::PCLPointField::UINT16, 2, cloud);
  AddField("instance", pcl::PCLPointField::UINT32, 4, cloud);
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(num_points);
  cloud.row_step = cloud.width * cloud.point_step;
  return cloud;
}

}  // namespace

Result<std::string> PcdHead(std::size_t num_vertices) {
  try {
    // PCDWriter::writeBinary only writes to a file name; this is what it writes.
    return pcl::PCDWriter().generateHeaderBinary(EmptyCloud(num_vertices), Eigen::Vector4f::Zero(),
                                                 Eigen::Quaternionf::Identity()) +
           "DATA binary\n";
  } catch (const std::exception& error) {
    return Internal(std::string("PCL cannot write the point cloud: ") + error.what());
  }
}

std::size_t PcdBodyBytes(std::size_t num_vertices) { return num_vertices * kPointBytes; }

void AppendPcdPoints(const Mesh& piece, std::string& file) {
  const std::size_t begin = file.size();
  file.resize(begin + PcdBodyBytes(piece.vertices_m.size()));
  char* out = file.data() + begin;
  for (std::size_t i = 0; i < piece.vertices_m.size(); ++i, out += kPointBytes) {
    const Color color = piece.colors[i];
    const std::uint32_t rgb = std::uint32_t{color.r} << 16 | std::uint32_t{color.g} << 8 | color.b;  // PCL's packing
    std::memcpy(out, piece.vertices_m[i].data(), 12);
    std::memcpy(out + 12, piece.normals[i].data(), 12);
    std::memcpy(out + 24, &rgb, 4);
    std::memcpy(out + 28, &piece.classes[i], 2);
    std::memcpy(out + 30, &piece.instances[i], 4);
  }
}

Result<std::string> WritePcd(const Mesh& mesh) {
  DHPMAP_ASSIGN_OR_RETURN(std::string file, PcdHead(mesh.vertices_m.size()));
  AppendPcdPoints(mesh, file);
  return file;
}

}  // namespace dhpmap
