// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/panoptic_noise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "clients/simulator/camera_path.h"
#include "tests/unit/clients/simulator/recorded_apartment.h"

namespace dhpmap::simulator {
namespace {

using testing::Apartment;

constexpr int kFrames = 60;

/// Round the apartment at a quarter of the usual width.
const std::vector<RenderedFrame>& Walk() {
  static const std::vector<RenderedFrame> frames = [] {
    const Renderer renderer(Apartment(), Renderer::Output::kGeometry);
    std::vector<RenderedFrame> rendered;
    for (int i = 0; i < kFrames; ++i) {
      rendered.push_back(renderer.Render(FlatLayoutCamera(160, 120), CameraPath().PoseOfFrame(i, kFrames)));
    }
    return rendered;
  }();
  return frames;
}

Prediction PredictionOf(int frame, const PanopticNoise& noise = {}, std::uint64_t seed = 1) {
  return PredictPanoptic(Walk()[static_cast<std::size_t>(frame)], Apartment().instances(), noise, seed,
                         static_cast<std::uint64_t>(frame));
}

PredictionErrors ErrorsOf(const PanopticNoise& noise) {
  PredictionErrors sum;
  for (int i = 0; i < kFrames; ++i) {
    for (std::uint64_t seed : {1, 2, 3, 4}) {
      const PredictionErrors errors = PredictionOf(i, noise, seed).errors;
      sum.num_things += errors.num_things;
      sum.num_missed += errors.num_missed;
      sum.num_wrong_class += errors.num_wrong_class;
      sum.num_merged += errors.num_merged;
      sum.num_split += errors.num_split;
    }
  }
  return sum;
}

TEST(PanopticNoise, ErrsAsOftenAsItSays) {
  for (const double level : {1.0, 2.0}) {
    const PredictionErrors sum = ErrorsOf(PanopticNoise().Times(level));
    ASSERT_GT(sum.num_things, 1500);
    const double missed = static_cast<double>(sum.num_missed) / sum.num_things;
    const double wrong = static_cast<double>(sum.num_wrong_class) / (sum.num_things - sum.num_missed);
    EXPECT_NEAR(missed, 0.06 * level, 0.02 * level);
    EXPECT_NEAR(wrong, 0.10 * level, 0.025 * level);
    EXPECT_GT(sum.num_merged, 0);
    EXPECT_GT(sum.num_split, 0);
  }
  EXPECT_EQ(PanopticNoise().Times(20).missed_share, 0.9) << "something is left";
}

TEST(PanopticNoise, PixelsShowTheErrorsThatAreCounted) {
  int num_things = 0, num_missed = 0, num_wrong = 0;
  for (int i = 0; i < kFrames; ++i) {
    const Prediction prediction = PredictionOf(i);
    const RenderedFrame& frame = Walk()[static_cast<std::size_t>(i)];
    std::vector<std::array<int, static_cast<std::size_t>(ObjectClass::kCount)>> votes(Apartment().instances().size());
    for (std::size_t p = 0; p < frame.instances.size(); ++p) {
      const std::uint8_t id = prediction.ids[p];
      const ObjectClass said = id == 0 ? ObjectClass::kUnknown : prediction.segments[id - 1u].object_class;
      ++votes[frame.instances[p]][static_cast<std::size_t>(said)];
    }
    for (const Instance& instance : Apartment().instances()) {
      int area = 0, most = 0;
      for (int count : votes[instance.id]) area += count;
      if (!InfoOf(instance.object_class).is_thing || area < 250) continue;  // borders would outweigh smaller ones
      for (std::size_t c = 1; c < votes[instance.id].size(); ++c) {
        if (votes[instance.id][c] > votes[instance.id][static_cast<std::size_t>(most)]) most = static_cast<int>(c);
      }
      ++num_things;
      if (most == 0) ++num_missed;
      if (most != 0 && static_cast<ObjectClass>(most) != instance.object_class) ++num_wrong;
    }
  }
  ASSERT_GT(num_things, 250);
  EXPECT_NEAR(static_cast<double>(num_missed) / num_things, 0.06, 0.04);
  EXPECT_NEAR(static_cast<double>(num_wrong) / num_things, 0.10, 0.05);
}

TEST(PanopticNoise, IsTheSameForASeedAndAnotherForAnother) {
  const Prediction once = PredictionOf(3), again = PredictionOf(3), other = PredictionOf(3, {}, 2);
  EXPECT_EQ(once.ids, again.ids);
  EXPECT_NE(once.ids, other.ids);
}

TEST(PanopticNoise, ListsEverySegmentOnceAndOnlyThose) {
  for (int i = 0; i < kFrames; ++i) {
    const Prediction prediction = PredictionOf(i);
    std::set<int> in_image(prediction.ids.begin(), prediction.ids.end()), listed{0};
    in_image.insert(0);
    std::set<ObjectClass> stuff;
    for (const PredictedSegment& segment : prediction.segments) {
      EXPECT_TRUE(listed.insert(segment.id).second);
      if (InfoOf(segment.object_class).is_thing) {
        EXPECT_GT(segment.score, 0.4f);
        EXPECT_LE(segment.score + segment.second_score, 1.0f);
        EXPECT_NE(segment.second_class, segment.object_class);
      } else {
        EXPECT_TRUE(stuff.insert(segment.object_class).second) << "one segment a stuff class";
      }
    }
    EXPECT_EQ(in_image, listed);
  }
}

TEST(PanopticNoise, WithoutNoiseGivesTheTruth) {
  const PanopticNoise none{.border_rms_px = 0,
                           .missed_share = 0,
                           .wrong_class_share = 0,
                           .merged_share = 0,
                           .split_share = 0,
                           .max_holes = 0,
                           .min_area_px = 0};
  const Prediction prediction = PredictionOf(5, none);
  for (std::size_t p = 0; p < prediction.ids.size(); ++p) {
    ASSERT_NE(prediction.ids[p], 0);
    EXPECT_EQ(prediction.segments[prediction.ids[p] - 1u].truth, Walk()[5].instances[p]);
  }
}

TEST(PanopticNoise, BordersWaveByAboutThreePixels) {
  // Left half one instance, right half another, at the full width.
  RenderedFrame frame{.camera = FlatLayoutCamera(640, 480)};
  for (int i = 0; i < 640 * 480; ++i) frame.instances.push_back(i % 640 < 320 ? 1 : 2);
  frame.depth_m.assign(640 * 480, 2.0f);
  const std::vector<Instance> two{{0, ObjectClass::kUnknown, "unknown"},
                                  {1, ObjectClass::kWall, "wall_001"},
                                  {2, ObjectClass::kFloor, "floor_001"}};
  const PanopticNoise only_waves{.max_holes = 0};
  double sum_of_squares = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Prediction prediction = PredictPanoptic(frame, two, only_waves, seed, 0);
    for (int v = 0; v < 480; ++v) {
      int left = 0;
      for (int u = 0; u < 640; ++u) {
        const std::uint8_t id = prediction.ids[static_cast<std::size_t>(v * 640 + u)];
        left += id != 0 && prediction.segments[id - 1u].object_class == ObjectClass::kWall ? 1 : 0;
      }
      sum_of_squares += (left - 320.0) * (left - 320.0);
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(sum_of_squares / count), 3.0, 0.8);
}

}  // namespace
}  // namespace dhpmap::simulator
