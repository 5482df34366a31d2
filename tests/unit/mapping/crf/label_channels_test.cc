// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/label_channels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace dhpmap {
namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

/// Places in a row; within reach is what is at most one away.
Neighbours Row(std::uint32_t num_places) {
  Neighbours neighbours(num_places);
  for (std::uint32_t p = 0; p < num_places; ++p) {
    for (std::uint32_t n = p == 0 ? 0 : p - 1; n <= p + 1 && n < num_places; ++n) neighbours[p].push_back(n);
  }
  return neighbours;
}

class RandomLabels : public ::testing::TestWithParam<unsigned> {
 protected:
  RandomLabels() {
    std::mt19937 random(GetParam());
    near_.resize(neighbours_.size());
    for (int i = 0; i < 300; ++i) {
      const auto place = static_cast<std::uint32_t>(random() % neighbours_.size());
      const auto label = static_cast<std::uint32_t>(1000 * (random() % (10 + 30 * GetParam())));  // at last over 64
      channels_.Add(place, label);
      for (const std::uint32_t n : neighbours_[place]) near_[n].insert(label);
    }
    channels_.Assign(neighbours_);
  }
  Neighbours neighbours_ = Row(150);
  LabelChannels channels_{neighbours_.size()};
  std::vector<std::set<std::uint32_t>> near_;  ///< labels within reach of each place
};

TEST_P(RandomLabels, WithinReachOfAPlaceAChannelMeansOneLabel) {
  std::size_t most = 0;
  std::set<std::uint32_t> all;
  for (std::uint32_t p = 0; p < near_.size(); ++p) {
    std::set<std::uint32_t> used;
    for (const std::uint32_t label : near_[p]) {
      const std::uint32_t channel = channels_.ChannelOf(label);
      ASSERT_LT(channel, static_cast<std::uint32_t>(channels_.num_channels()));
      EXPECT_TRUE(used.insert(channel).second) << "labels within reach of each other share a channel";
      EXPECT_EQ(channels_.LabelAt(p, channel), label);
    }
    for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(channels_.num_channels()); ++c) {
      EXPECT_EQ(channels_.LabelAt(p, c) == LabelChannels::kNone, !used.contains(c));
    }
    most = std::max(most, near_[p].size());
    all.insert(near_[p].begin(), near_[p].end());
  }
  EXPECT_GE(channels_.num_channels(), static_cast<int>(most));
  EXPECT_LE(channels_.num_channels(), static_cast<int>(all.size()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomLabels, ::testing::Range(0u, 6u));

TEST(LabelChannels, ManyObjectsInARowNeedAsManyChannelsAsAreWithinReach) {
  LabelChannels channels(100);
  for (std::uint32_t p = 0; p < 100; ++p) channels.Add(p, 7 + p);  // each place sees itself and both neighbours
  channels.Assign(Row(100));
  EXPECT_LE(channels.num_channels(), 5);
  EXPECT_GE(channels.num_channels(), 3);
}

TEST(LabelChannels, SayingSoAgainChangesNothing) {
  LabelChannels channels(1);
  channels.Add(0, 5);
  channels.Add(0, 5);
  channels.Assign(Row(1));
  EXPECT_EQ(channels.num_channels(), 1);
  EXPECT_EQ(channels.LabelAt(0, channels.ChannelOf(5)), 5u);
}

TEST(LabelChannels, NothingAtAllIsNoChannel) {
  LabelChannels channels(2);
  channels.Assign(Row(2));
  EXPECT_EQ(channels.num_channels(), 0);
}

}  // namespace
}  // namespace dhpmap
