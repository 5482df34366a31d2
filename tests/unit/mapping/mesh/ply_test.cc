// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/ply.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <sstream>

#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

const std::map<std::string, std::size_t> kTypeBytes = {
    {"float", 4}, {"uchar", 1}, {"ushort", 2}, {"uint", 4}, {"int", 4}};

/// Reads binary little-endian PLY with scalar vertex properties and one list property of the faces.
struct PlyFile {
  std::vector<std::string> vertex_properties;  // "type name"
  std::vector<std::map<std::string, double>> vertices;
  std::vector<std::vector<std::int32_t>> faces;
  std::size_t bytes_left = 0;

  explicit PlyFile(const std::string& file) {
    const std::size_t body = file.find("end_header\n") + std::strlen("end_header\n");
    std::istringstream header(file.substr(0, body));
    std::size_t num_vertices = 0, num_faces = 0;
    std::string line;
    bool in_vertices = false;
    std::getline(header, line);
    EXPECT_EQ(line, "ply");
    std::getline(header, line);
    EXPECT_EQ(line, "format binary_little_endian 1.0");
    while (std::getline(header, line)) {
      if (line.starts_with("element vertex ")) num_vertices = std::stoul(line.substr(15));
      if (line.starts_with("element face ")) num_faces = std::stoul(line.substr(13));
      if (line.starts_with("element")) in_vertices = line.starts_with("element vertex");
      if (line.starts_with("property") && in_vertices) vertex_properties.push_back(line.substr(9));
      if (line.starts_with("property") && !in_vertices) {
        EXPECT_EQ(line, "property list uchar int vertex_indices");
      }
    }
    const char* in = file.data() + body;
    for (std::size_t i = 0; i < num_vertices; ++i) vertices.push_back(ReadVertex(in));
    for (std::size_t i = 0; i < num_faces; ++i) {
      std::vector<std::int32_t> face(static_cast<std::uint8_t>(*in++));
      std::memcpy(face.data(), in, 4 * face.size());
      in += 4 * face.size();
      faces.push_back(face);
    }
    bytes_left = static_cast<std::size_t>(file.data() + file.size() - in);
  }

  std::map<std::string, double> ReadVertex(const char*& in) const {
    std::map<std::string, double> vertex;
    for (const std::string& property : vertex_properties) {
      const std::string type = property.substr(0, property.find(' ')), name = property.substr(property.find(' ') + 1);
      std::uint32_t bits = 0;
      std::memcpy(&bits, in, kTypeBytes.at(type));
      in += kTypeBytes.at(type);
      float real = 0;
      std::memcpy(&real, &bits, 4);
      vertex[name] = type == "float" ? static_cast<double>(real) : static_cast<double>(bits);
    }
    return vertex;
  }
};

Mesh SampleMesh() {
  Mesh mesh = ExtractMesh(testing::SolidSubmap(testing::Sphere({0.01, 0.02, 0.03}, 0.3), {-1, -1, -1}, {0, 0, 0}),
                          LabelSet(), MeshColoring::kSensor);
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    mesh.colors[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i + 100), 255};
    mesh.classes[i] = static_cast<std::uint16_t>(60'000 + i % 5'000);
    mesh.instances[i] = 4'000'000'000u + static_cast<std::uint32_t>(i);
  }
  return mesh;
}

TEST(WritePly, ReadsBackWithEveryProperty) {
  const Mesh mesh = SampleMesh();
  const PlyFile ply(WritePly(mesh));
  EXPECT_EQ(ply.vertex_properties,
            (std::vector<std::string>{"float x", "float y", "float z", "float nx", "float ny", "float nz", "uchar red",
                                      "uchar green", "uchar blue", "ushort class", "uint instance"}));
  EXPECT_EQ(ply.bytes_left, 0u);
  ASSERT_EQ(ply.vertices.size(), mesh.vertices_m.size());
  ASSERT_EQ(ply.faces.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    const std::map<std::string, double> expected = {
        {"x", mesh.vertices_m[i].x()}, {"y", mesh.vertices_m[i].y()},  {"z", mesh.vertices_m[i].z()},
        {"nx", mesh.normals[i].x()},   {"ny", mesh.normals[i].y()},    {"nz", mesh.normals[i].z()},
        {"red", mesh.colors[i].r},     {"green", mesh.colors[i].g},    {"blue", mesh.colors[i].b},
        {"class", mesh.classes[i]},    {"instance", mesh.instances[i]}};
    ASSERT_EQ(ply.vertices[i], expected) << "vertex " << i;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    ASSERT_EQ(ply.faces[i], (std::vector<std::int32_t>{static_cast<std::int32_t>(a), static_cast<std::int32_t>(b),
                                                       static_cast<std::int32_t>(c)}));
  }
}

TEST(WritePly, EmptyMeshIsAHeader) {
  const PlyFile ply(WritePly(Mesh()));
  EXPECT_TRUE(ply.vertices.empty());
  EXPECT_TRUE(ply.faces.empty());
  EXPECT_EQ(ply.bytes_left, 0u);
}

}  // namespace
}  // namespace dhpmap
