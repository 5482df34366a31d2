// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/ply.h"

#include <bit>
#include <cstring>

namespace dhpmap {
namespace {

static_assert(std::endian::native == std::endian::little, "records are copied as they are in memory");

constexpr std::size_t kVertexBytes = 6 * sizeof(float) + 3 + sizeof(std::uint16_t) + sizeof(std::uint32_t);
constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::int32_t);

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

std::string PlyHead(std::size_t num_vertices, std::size_t num_triangles) {
  return "ply\nformat binary_little_endian 1.0\ncomment metres, map frame\nelement vertex " +
         std::to_string(num_vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
         "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty ushort class\n"
         "property uint instance\nelement face " +
         std::to_string(num_triangles) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::size_t PlyBodyBytes(std::size_t num_vertices, std::size_t num_triangles) {
  return num_vertices * kVertexBytes + num_triangles * kFaceBytes;
}

void AppendPlyVertices(const Mesh& piece, std::string& file) {
  const std::size_t begin = file.size();
  file.resize(begin + piece.vertices_m.size() * kVertexBytes);
  char* out = file.data() + begin;
  for (std::size_t i = 0; i < piece.vertices_m.size(); ++i) {
    out = Put(piece.vertices_m[i], out);
    out = Put(piece.normals[i], out);
    for (const std::uint8_t channel : {piece.colors[i].r, piece.colors[i].g, piece.colors[i].b})
      out = Put(channel, out);
    out = Put(piece.classes[i], out);
    out = Put(piece.instances[i], out);
  }
}

void AppendPlyTriangles(const Mesh& piece, std::string& file) {
  const std::size_t begin = file.size();
  file.resize(begin + piece.triangles.size() * kFaceBytes);
  char* out = file.data() + begin;
  for (const std::array<std::uint32_t, 3>& triangle : piece.triangles) {
    out = Put(std::uint8_t{3}, out);
    out = Put(triangle, out);
  }
}

std::string WritePly(const Mesh& mesh) {
  std::string file = PlyHead(mesh.vertices_m.size(), mesh.triangles.size());
  file.reserve(file.size() + PlyBodyBytes(mesh.vertices_m.size(), mesh.triangles.size()));
  AppendPlyVertices(mesh, file);
  AppendPlyTriangles(mesh, file);
  return file;
}

}  // namespace dhpmap
