// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/io/glb.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

namespace dhpmap {
namespace {

using Json = nlohmann::json;

Mesh OneTriangle() {
  Mesh mesh;
  mesh.vertices_m = {{1, 2, 3}, {3, 2, 3}, {1, 3, 3}};
  mesh.normals.assign(3, Eigen::Vector3f(0, 0, 1));
  mesh.colors = {{255, 0, 0}, {0, 128, 0}, {0, 0, 255}};
  mesh.classes.assign(3, 4);
  mesh.instances.assign(3, 7);
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

template <typename T>
T At(const std::string& file, std::size_t offset) {
  T value;
  std::memcpy(&value, file.data() + offset, sizeof value);
  return value;
}

Json JsonOf(const std::string& glb) { return Json::parse(glb.substr(20, At<std::uint32_t>(glb, 12))); }
std::size_t BinaryOf(const std::string& glb) { return 20 + At<std::uint32_t>(glb, 12) + 8; }

TEST(Glb, IsFramedAsTheStandardSays) {
  const Mesh mesh = OneTriangle();
  const std::string glb = WriteGlb(std::vector<GlbObject>{{.name = "a", .mesh = &mesh}});
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(At<std::uint32_t>(glb, 4), 2u);
  EXPECT_EQ(At<std::uint32_t>(glb, 8), glb.size());
  EXPECT_EQ(glb.size() % 4, 0u);
  const Json json = JsonOf(glb);
  EXPECT_EQ(BinaryOf(glb) + json["buffers"][0]["byteLength"].get<std::size_t>(), glb.size());
  for (const Json& view : json["bufferViews"]) EXPECT_EQ(view["byteOffset"].get<int>() % 4, 0);
}

TEST(Glb, PositionsComeBackToWithinAStep) {
  const Mesh mesh = OneTriangle();
  const std::string glb = WriteGlb(std::vector<GlbObject>{{.name = "a", .mesh = &mesh}});
  const Json json = JsonOf(glb);
  const Json& node = json["nodes"][1];
  const double scale_m = node["scale"][0].get<double>();
  EXPECT_EQ(scale_m, 2) << "the largest side";
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto step = At<std::uint16_t>(glb, BinaryOf(glb) + 20 * i + 2 * axis);
      const double back_m = node["translation"][axis].get<double>() + scale_m * step / 65535;
      EXPECT_NEAR(back_m, mesh.vertices_m[i][static_cast<int>(axis)], scale_m / 65535);
    }
  }
}

TEST(Glb, NormalsColoursAndTrianglesComeBack) {
  const Mesh mesh = OneTriangle();
  const std::string glb = WriteGlb(std::vector<GlbObject>{{.name = "a", .mesh = &mesh}});
  const std::size_t vertex = BinaryOf(glb) + 20;
  EXPECT_EQ(At<std::int8_t>(glb, vertex + 10), 127);
  EXPECT_EQ(At<std::uint16_t>(glb, vertex + 12), 0);
  EXPECT_NEAR(At<std::uint16_t>(glb, vertex + 14), 65535 * 0.2159, 10) << "sRGB 128 is 21.6 % of the light";
  const std::size_t indices = BinaryOf(glb) + JsonOf(glb)["bufferViews"][1]["byteOffset"].get<std::size_t>();
  EXPECT_EQ(At<std::uint16_t>(glb, indices + 2), 1);
}

TEST(Glb, EachObjectIsANodeWithItsPoseAndExtras) {
  const Mesh mesh = OneTriangle(), empty;
  Transform T_map_b = Transform::Identity();
  T_map_b.translation() << 1, 2, 3;
  const Json json = JsonOf(
      WriteGlb(std::vector<GlbObject>{{.name = "maps/m/submaps/1", .extras = R"({"instance_id":1})", .mesh = &mesh},
                                      {.name = "b", .T_file_object = T_map_b, .mesh = &empty}}));
  EXPECT_EQ(json["scenes"][0]["nodes"], Json({0, 2}));
  EXPECT_EQ(json["nodes"][0]["extras"]["instance_id"], 1);
  EXPECT_EQ(json["nodes"][0]["children"], Json({1}));
  EXPECT_EQ(json["nodes"][2]["translation"], Json({1, 2, 3}));
  EXPECT_FALSE(json["nodes"][2].contains("children")) << "without triangles";
  EXPECT_EQ(json["meshes"].size(), 1u);
}

TEST(Glb, MeshesOfManyVerticesHaveLongIndices) {
  Mesh mesh = OneTriangle();
  mesh.vertices_m.resize(65536, {1, 2, 3});
  mesh.normals.resize(65536, {0, 0, 1});
  mesh.colors.resize(65536);
  EXPECT_EQ(JsonOf(WriteGlb(std::vector<GlbObject>{{.name = "a", .mesh = &mesh}}))["accessors"][3]["componentType"],
            5125);
}

TEST(Glb, WithoutObjectsIsAnEmptyScene) {
  const Json json = JsonOf(WriteGlb({}));
  EXPECT_FALSE(json.contains("meshes"));
  EXPECT_EQ(json["scenes"].size(), 1u);
}

}  // namespace
}  // namespace dhpmap
