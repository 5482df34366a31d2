// SPDX-License-Identifier: BSD-3-Clause
// All of libdhpmap_pcl.so. It shares headers with who loads it, but no code.
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <exception>

#include "mapping/loaded/cloud_files.h"

namespace dhpmap {
namespace {

void AddField(const CloudField& given, pcl::PCLPointCloud2& cloud) {
  pcl::PCLPointField field;
  field.name = given.name;
  field.offset = cloud.point_step;
  field.datatype = given.type == CloudField::Type::kUint16   ? pcl::PCLPointField::UINT16
                   : given.type == CloudField::Type::kUint32 ? pcl::PCLPointField::UINT32
                                                             : pcl::PCLPointField::FLOAT32;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += given.type == CloudField::Type::kUint16 ? 2 : 4;
}

std::string PcdHead(std::span<const CloudField> fields, std::size_t num_points, std::string& head) {
  try {
    pcl::PCLPointCloud2 cloud;  // without its points
    for (const CloudField& field : fields) AddField(field, cloud);
    cloud.height = 1;
    cloud.width = static_cast<std::uint32_t>(num_points);
    cloud.row_step = cloud.width * cloud.point_step;
    // PCDWriter::writeBinary only writes to a file name; this is what it writes.
    head = pcl::PCDWriter().generateHeaderBinary(cloud, Eigen::Vector4f::Zero(), Eigen::Quaternionf::Identity()) +
           "DATA binary\n";
    return {};
  } catch (const std::exception& error) {
    return std::string("PCL cannot write the point cloud: ") + error.what();
  }
}

}  // namespace
}  // namespace dhpmap

extern "C" __attribute__((visibility("default"))) const dhpmap::CloudFiles dhpmap_cloud_files;
const dhpmap::CloudFiles dhpmap_cloud_files = {.pcd_head = dhpmap::PcdHead};
