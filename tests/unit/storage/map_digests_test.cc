// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/storage/map_digests.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "tests/unit/storage/map_fixtures.h"
#include "tests/unit/storage/map_text.h"

namespace dhpmap {
namespace {

using testing::DigestOf;
using testing::DigestsOf;

std::string SomeText() {
  testing::MapGenerator generator(5);
  Map map(generator.Info("m"));
  for (int n = 0; n < 3; ++n) generator.AddSubmap(map, 4);
  return testing::TextOf(*map.Publish(7)) + testing::TextOf(std::vector<ConfigRow>{{1, "voxel_size_m", "0.1"}});
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(MapDigests, AreFnvAsItsAuthorsPublishedIt) {
  EXPECT_EQ(DigestOf(""), "6c62272e07bb014262b821756295c58d");
  EXPECT_EQ(DigestOf("foobar"), "343e1662793c64bf6f0d3597ba446f18");
}

TEST(MapDigests, SayOfEachSectionWhatAReaderLooksFor) {
  const std::string text =
      "map 'm' 'M' revision 9 frames 4 next_submap_id 8\ncreate_time_ns 1 update_time_ns 2\n"
      "class 1 'it's' panoptic 2 size 2 color 1 2 3\nclass 10 'chair' panoptic 1 size 1 color 1 2 3\n"
      "submap 7 'class 1' panoptic 1 class 10 fixed\n  activity 0 confirmed 1 revision 6\n"
      "  block 0 0 0\n    tsdf 12 voxels 0a\n    labels 5 voxels 0b\n  block 0 0 1\n    tsdf 30 voxels 0c\n"
      "config a = 1\nconfig b = 2\n";
  const std::vector<std::string> lines = LinesOf(DigestsOf(text));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0].substr(34), "map 'm' 'M' revision 9 frames 4 next_submap_id 8");
  EXPECT_EQ(lines[1].substr(34), "class: 2 lines");
  EXPECT_EQ(lines[2].substr(34), "submap 7 'class 1' (chair): revision 6, voxels 42 tsdf 5 labels 0 gone");
  EXPECT_EQ(lines[3].substr(34), "config: 2 lines");
  EXPECT_EQ(lines[3].substr(0, 34), DigestOf("config a = 1\nconfig b = 2\n") + "  ");
}

TEST(MapDigests, AnyByteThatChangesChangesTheLineOfItsSectionAlone) {
  const std::string text = SomeText();
  const std::vector<std::string> lines = LinesOf(DigestsOf(text));
  ASSERT_GT(lines.size(), 5u);
  for (std::size_t i = 0; i < text.size(); i += 7) {
    if (text[i] < '0' || text[i] > '9') continue;
    std::string changed = text;
    changed[i] = text[i] == '9' ? '8' : static_cast<char>(text[i] + 1);
    const std::vector<std::string> now = LinesOf(DigestsOf(changed));
    ASSERT_EQ(now.size(), lines.size()) << i;
    int num_changed = 0;
    for (std::size_t k = 0; k < lines.size(); ++k) num_changed += now[k].substr(0, 32) != lines[k].substr(0, 32);
    EXPECT_EQ(num_changed, 1) << "byte " << i;
  }
}

}  // namespace
}  // namespace dhpmap
