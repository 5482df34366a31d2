// SPDX-License-Identifier: BSD-3-Clause
// What a depth camera is said to have looked through, against exact rays through analytic scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "mapping/space/free_space_finder.h"
#include "tests/unit/mapping/space/looked_through_scene.h"

namespace dhpmap {
namespace {

using testing::CastRay;
using testing::ForEachVoxel;
using testing::FurnishedRoom;
using testing::MapOfLooks;
using testing::RoomFrame;
using testing::Scene;
using testing::Solid;

/// How one voxel stands to one frame.
enum class Truth { kFree, kNearSurface, kHidden, kOutOfView };

Truth TruthOf(const Eigen::Vector3d& p_map, const PanopticFrame& frame, const Scene& scene, const MapConfig& config) {
  const PinholeCamera& camera = frame.camera->camera;
  const Eigen::Vector3d p = frame.T_map_sensor.inverse() * p_map;
  if (p.z() <= 0) return Truth::kOutOfView;
  const double u = camera.fx_px * p.x() / p.z() + camera.cx_px, v = camera.fy_px * p.y() / p.z() + camera.cy_px;
  if (u < -0.5 || v < -0.5 || u >= camera.width_px - 0.5 || v >= camera.height_px - 0.5) return Truth::kOutOfView;
  const Eigen::Vector3d eye = frame.T_map_sensor.translation();
  const double range = (p_map - eye).norm(), hit = CastRay(scene, eye, (p_map - eye) / range);
  if (range > config.integration.max_range_m) return Truth::kOutOfView;
  if (range < hit - config.truncation_m) return std::isfinite(hit) ? Truth::kFree : Truth::kOutOfView;
  return range <= hit ? Truth::kNearSurface : Truth::kHidden;
}

/// Whether a ray through the pixels around that of a point, which is behind an edge, goes beyond the point.
bool IsBesideAnEdge(const Eigen::Vector3d& p_map, const PanopticFrame& frame, const Scene& scene) {
  const PinholeCamera& camera = frame.camera->camera;
  const Eigen::Vector3d p = frame.T_map_sensor.inverse() * p_map;
  for (const double du_px : {-2.0, 0.0, 2.0}) {
    for (const double dv_px : {-2.0, 0.0, 2.0}) {
      const Eigen::Vector3d shifted = p + p.z() * Eigen::Vector3d(du_px / camera.fx_px, dv_px / camera.fy_px, 0);
      const Eigen::Vector3d ray = frame.T_map_sensor.linear() * shifted.normalized();
      if (p.z() > 0 && CastRay(scene, frame.T_map_sensor.translation(), ray) > shifted.norm()) return true;
    }
  }
  return false;
}

struct CameraScore {
  std::int64_t num_free = 0, num_found = 0;    ///< truly free by some frame; of these, said to be
  std::int64_t num_unseen = 0, num_wrong = 0;  ///< hidden from or out of view of every frame; of these, said to be free
  std::int64_t num_behind = 0;                 ///< of those said wrongly, not even beside an edge of what hides them
};

CameraScore CompareFrames(const Map& map, const std::vector<PanopticFrame>& frames, const Scene& scene,
                          double beyond_m = 0.4) {
  const MapConfig& config = map.info().config;
  CameraScore score;
  const Eigen::Vector3d room(2.5 + beyond_m, 2.0 + beyond_m, 1.3 + beyond_m), middle(0, 0, 1.3);
  ForEachVoxel(middle - room, middle + room, config.voxel_size_m, [&](VoxelIndex voxel) {
    const Eigen::Vector3d p = VoxelCentre(voxel, config.voxel_size_m);
    bool is_free = false, is_near = false;
    for (const PanopticFrame& frame : frames) {
      const Truth truth = TruthOf(p, frame, scene, config);
      is_free = is_free || truth == Truth::kFree;
      is_near = is_near || truth == Truth::kNearSurface;
    }
    const bool is_said = map.free_space().IsFree(voxel);
    if (is_free) {
      ++score.num_free;
      score.num_found += is_said;
    } else if (!is_near) {
      ++score.num_unseen;
      if (!is_said) return;
      ++score.num_wrong;
      score.num_behind += std::none_of(frames.begin(), frames.end(),
                                       [&](const PanopticFrame& frame) { return IsBesideAnEdge(p, frame, scene); });
    }
  });
  return score;
}

std::vector<PanopticFrame> Walk(const Scene& scene, int num_frames) {
  std::vector<PanopticFrame> frames;
  for (int i = 0; i < num_frames; ++i) frames.push_back(RoomFrame(i, scene));
  return frames;
}

/// Noise of a structured-light camera; at depth edges some pixels are lost and some lie between both surfaces.
void Spoil(PanopticFrame& frame, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise;
  std::uniform_real_distribution<float> chance;
  std::vector<float>& depth_m = frame.camera->depth_m;
  const std::vector<float> clean_m = depth_m;
  const int width = frame.camera->camera.width_px, height = frame.camera->camera.height_px;
  for (int v = 1; v + 1 < height; ++v) {
    for (int u = 1; u + 1 < width; ++u) {
      const auto at = [&](int du, int dv) { return clean_m[static_cast<std::size_t>((v + dv) * width + u + du)]; };
      const float least = std::min({at(0, 0), at(1, 0), at(-1, 0), at(0, 1), at(0, -1)});
      const float most = std::max({at(0, 0), at(1, 0), at(-1, 0), at(0, 1), at(0, -1)});
      float& z = depth_m[static_cast<std::size_t>(v * width + u)];
      const float d = at(0, 0) - 0.4f;
      z += noise(random) * (0.0012f + 0.0019f * d * d);
      if (most - least > 0.05f) {
        const float what = chance(random);
        if (what < 0.4f) z = 0;
        else if (what < 0.6f) z = least + chance(random) * (most - least);
      }
      if (chance(random) < 0.01f) z = 0;
    }
  }
}

TEST(CameraLook, FindsWhatIsBeforeTheSurfacesAndNothingBehindThem) {
  const Scene scene = FurnishedRoom();
  const std::vector<PanopticFrame> frames = Walk(scene, 3);
  const Map map = MapOfLooks({}, frames);
  const CameraScore score = CompareFrames(map, frames, scene);
  EXPECT_GT(score.num_free, 50'000);
  EXPECT_GT(score.num_unseen, 50'000);
  EXPECT_GE(static_cast<double>(score.num_found), 0.98 * static_cast<double>(score.num_free));
  EXPECT_LE(static_cast<double>(score.num_wrong), 0.001 * static_cast<double>(score.num_unseen));
  EXPECT_EQ(score.num_behind, 0);
}

TEST(CameraLook, NoiseDropOutsAndMixedPixelsAtEdgesMakeNothingBehindASurfaceFree) {
  const Scene scene = FurnishedRoom();
  std::vector<PanopticFrame> frames = Walk(scene, 3);
  unsigned seed = 1;
  for (PanopticFrame& frame : frames) Spoil(frame, seed++);
  const Map map = MapOfLooks({}, frames);
  const CameraScore score = CompareFrames(map, frames, scene);
  EXPECT_GE(static_cast<double>(score.num_found), 0.97 * static_cast<double>(score.num_free));
  EXPECT_LE(static_cast<double>(score.num_wrong), 0.001 * static_cast<double>(score.num_unseen));
  EXPECT_EQ(score.num_behind, 0);
}

}  // namespace
}  // namespace dhpmap
