// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/file_reader.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <thread>

#include "clients/datasets/label_table.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/datasets/dataset_files.h"

namespace dhpmap::testing {
namespace {

TEST(ParseSeconds, IsExactForDecimalsAndTakesExponents) {
  EXPECT_EQ(*ParseSeconds("1305031102.175304"), 1305031102175304000);
  EXPECT_EQ(*ParseSeconds(" 7 "), 7'000'000'000);
  EXPECT_EQ(*ParseSeconds("1.038752e-01"), 103'875'200);
  EXPECT_EQ(*ParseSeconds("-0.5"), -500'000'000);
  for (const char* bad : {"", "soon", "1.2.3", "nan", "1e99"}) EXPECT_FALSE(ParseSeconds(bad).ok()) << bad;
}

TEST(ParseNumber, TakesTheWholeCell) {
  EXPECT_EQ(*ParseNumber("+1.5e3"), 1500);
  EXPECT_TRUE(std::isnan(*ParseNumber("nan")));
  for (const char* bad : {"", "1,5", "0x10", "1 2"}) EXPECT_FALSE(ParseNumber(bad).ok()) << bad;
}

TEST(ReadRows, TrimsCellsAndSkipsCommentsBlanksAndByteOrderMarks) {
  const TempDir temp;
  WriteText(temp.path() / "a.csv",
            "\xEF\xBB\xBF"
            "a, b ,c\r\n\r\n# no\r\n1,,3");
  const auto rows = ReadRows(temp.path() / "a.csv", ',');
  ASSERT_TRUE(rows.ok());
  ASSERT_EQ(rows->size(), 2u);
  EXPECT_EQ((*rows)[0].cells, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ((*rows)[1].cells, (std::vector<std::string>{"1", "", "3"}));
  EXPECT_EQ((*rows)[1].line, 4);
}

TEST(ReadText, OfAFolderIsAnError) {
  const TempDir temp;
  EXPECT_EQ(ReadText(temp.path()).status().reason(), Reason("MISSING_FILE"));
  WriteText(temp.path() / "empty", "");
  EXPECT_EQ(*ReadText(temp.path() / "empty"), "");
}

TEST(ReadText, OfAPipeIsWhatComesThroughIt) {
  const TempDir temp;
  const std::filesystem::path pipe = temp.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&pipe] { WriteText(pipe, "a line\n"); });
  const auto text = ReadText(pipe);
  const int last_reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);  // else the writer may hang
  writer.join();
  ::close(last_reader);
  ASSERT_TRUE(text.ok()) << text.status().ToString();
  EXPECT_EQ(*text, "a line\n");
}

TEST(ClassNames, DropWhatTellsInstancesApart) {
  EXPECT_EQ(ClassNameOfInstance("ChairA_01_003"), "Chair");
  EXPECT_EQ(ClassNameOfInstance("TV_01_001"), "TV");
  EXPECT_EQ(ClassNameOfInstance("wall"), "wall");
  EXPECT_EQ(ClassNameOfInstance("_01"), "_01");
  EXPECT_EQ(CommonName({"Door", "FoldingDoor"}), "Door");
  EXPECT_EQ(CommonName({"Lamp", "LampStand"}), "Lamp");
  EXPECT_EQ(CommonName({"Sofa", "Bed"}), "Sofa");
}

}  // namespace
}  // namespace dhpmap::testing
