// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/surface_view.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dhpmap::evaluator {
namespace {

constexpr Color kRed{200, 0, 0}, kBlue{0, 0, 200}, kWhite{255, 255, 255};

/// A square of side 1 m around (x, y, z), to be seen from above, or if not `up` from below.
void AddSquare(float x, float y, float z, bool up, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const auto& [dx, dy] : {std::pair{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}}) {
    mesh.vertices_m.emplace_back(x + dx, y + dy, z);
    mesh.normals.emplace_back(0, 0, up ? 1 : -1);
  }
  if (up) mesh.triangles.insert(mesh.triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  else mesh.triangles.insert(mesh.triangles.end(), {{first, first + 2, first + 1}, {first, first + 3, first + 2}});
}

/// The first square is red, the others are blue.
Picture Painted(const Mesh& mesh, Sides sides) {
  const SurfaceView view(mesh, Eigen::Matrix3f::Identity(), sides, 100);
  return view.Paint([](std::uint32_t triangle) { return triangle < 2 ? kRed : kBlue; });
}

bool IsRed(Color c) { return c.r > 60 && c.b == 0; }
bool IsBlue(Color c) { return c.b > 60 && c.r == 0; }

TEST(SurfaceView, ShowsWhatIsNearer) {
  Mesh mesh;
  AddSquare(0, 0, 1, true, mesh);
  AddSquare(0, 0, 0, true, mesh);
  AddSquare(1, 0, 0, true, mesh);
  const Picture picture = Painted(mesh, Sides::kFront);
  EXPECT_NEAR(picture.width_px, 100, 1);
  EXPECT_NEAR(picture.height_px, 50, 1);
  EXPECT_TRUE(IsRed(picture.at(25, 25)));
  EXPECT_TRUE(IsBlue(picture.at(75, 25)));
}

TEST(SurfaceView, HasNorthAboveAndEastToTheRight) {
  Mesh mesh;
  AddSquare(0, 1, 0, true, mesh);
  AddSquare(1, 0, 0, true, mesh);
  const Picture picture = Painted(mesh, Sides::kFront);
  EXPECT_TRUE(IsRed(picture.at(25, 25)));
  EXPECT_TRUE(IsBlue(picture.at(75, 75)));
  EXPECT_EQ(picture.at(75, 25), kWhite);
  EXPECT_EQ(picture.at(25, 75), kWhite);
}

TEST(SurfaceView, LooksThroughBacksIntoRooms) {
  Mesh mesh;
  AddSquare(0, 0, 0, true, mesh);   // a floor
  AddSquare(0, 0, 2, false, mesh);  // a ceiling
  EXPECT_TRUE(IsRed(Painted(mesh, Sides::kFront).at(50, 50)));
  EXPECT_TRUE(IsBlue(Painted(mesh, Sides::kBoth).at(50, 50)));
}

TEST(SurfaceView, LightsSlopesByWhereTheyFace) {
  Mesh mesh;
  AddSquare(0, 0, 0, true, mesh);
  AddSquare(1, 0, 0, true, mesh);
  for (std::size_t i = 4; i < 8; ++i) mesh.normals[i] = Eigen::Vector3f(1, 0, 0.1f).normalized();
  const Picture picture = Painted(mesh, Sides::kFront);
  EXPECT_GT(picture.at(25, 25).r, picture.at(75, 25).b + 20) << "the lamp is to the left";
}

TEST(SurfaceView, HasNoHolesBetweenTriangles) {
  Mesh mesh;
  for (int x = 0; x < 9; ++x) {
    for (int y = 0; y < 9; ++y) AddSquare(static_cast<float>(x), static_cast<float>(y), 0, true, mesh);
  }
  const Picture picture = Painted(mesh, Sides::kFront);
  int num_white = 0;
  for (int y = 1; y < picture.height_px - 2; ++y) {
    for (int x = 1; x < picture.width_px - 2; ++x) num_white += picture.at(x, y).r > 200 && picture.at(x, y).g > 0;
  }
  EXPECT_EQ(num_white, 0);
}

TEST(SurfaceView, OfNothingIsAPictureOfNothing) {
  const Picture picture = Painted({}, Sides::kBoth);
  EXPECT_TRUE(std::all_of(picture.pixels.begin(), picture.pixels.end(), [](Color c) { return c == kWhite; }));
}

}  // namespace
}  // namespace dhpmap::evaluator
