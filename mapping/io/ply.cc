// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/ply.h"

#include <bit>
#include <cstring>

namespace dhpmap {
namespace {

static_assert(std::endian::native == std::endian::little, "records are copied as they are in memory");

constexpr std::size_t kVertexBytes = 6 * sizeof(float) + 3 + sizeof(std::uint16_t) + sizeof(std::uint32_t);
constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::int32_t);

std::string Header(const Mesh& mesh) {
  return "ply\nformat binary_little_endian 1.0\ncomment metres, map frame\nelement vertex " +
         std::to_string(mesh.vertices_m.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
         "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty ushort class\n"
         "property uint instance\nelement face " +
         std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

template <typename T>
char* Put(const T& value, char* out) {
  std::memcpy(out, &value, sizeof value);
  return out + sizeof value;
}

char* Put(const Eigen::Vector3f& value, char* out) {
  std::memcpy(out, value.data(), 3 * sizeof(float));
  return out + 3 * sizeof(float);
}

}  // namespace

std::string WritePly(const Mesh& mesh) {
  std::string file = Header(mesh);
  const std::size_t header_bytes = file.size();
  file.resize(header_bytes + mesh.vertices_m.size() * kVertexBytes + mesh.triangles.size() * kFaceBytes);
  char* out = file.data() + header_bytes;
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    out = Put(mesh.vertices_m[i], out);
    out = Put(mesh.normals[i], out);
    for (const std::uint8_t channel : {mesh.colors[i].r, mesh.colors[i].g, mesh.colors[i].b}) out = Put(channel, out);
    out = Put(mesh.classes[i], out);
    out = Put(mesh.instances[i], out);
  }
  for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
    out = Put(std::uint8_t{3}, out);
    out = Put(triangle, out);
  }
  return file;
}

}  // namespace dhpmap
