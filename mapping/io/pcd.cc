// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/pcd.h"

#include <cstring>
#include <span>
#include <string>

#include "mapping/loaded/cloud_files.h"

namespace dhpmap {
namespace {

using Type = CloudField::Type;

constexpr CloudField kFields[] = {{"x", Type::kFloat},        {"y", Type::kFloat},        {"z", Type::kFloat},
                                  {"normal_x", Type::kFloat}, {"normal_y", Type::kFloat}, {"normal_z", Type::kFloat},
                                  {"rgb", Type::kFloat},      {"class", Type::kUint16},   {"instance", Type::kUint32}};
constexpr std::size_t kPointBytes = 34;

}  // namespace

Result<std::string> PcdHead(std::size_t num_vertices) {
  DHPMAP_ASSIGN_OR_RETURN(const CloudFiles* files, LoadCloudFiles());
  std::string head;
  if (std::string problem = files->pcd_head(std::span(kFields), num_vertices, head); !problem.empty())
    return Internal(problem);
  return head;
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
