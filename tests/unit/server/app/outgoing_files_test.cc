// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/outgoing_files.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

using std::chrono::hours;

class CountedFile final : public StoreBackup {
 public:
  explicit CountedFile(int& num_open) : num_open_(num_open) { ++num_open_; }
  ~CountedFile() override { --num_open_; }
  [[nodiscard]] std::int64_t size_bytes() const override { return 4; }
  Result<std::string> Read(std::size_t) override { return std::string("part"); }

 private:
  int& num_open_;
};

class OutgoingFilesTest : public ::testing::Test {
 protected:
  OutgoingFiles::Opened Open(OutgoingFiles& files) {
    return files.Open([this]() -> OutgoingFiles::Opened {
      return std::unique_ptr<StoreBackup>(std::make_unique<CountedFile>(num_open_));
    });
  }
  int num_open_ = 0;
};

TEST_F(OutgoingFilesTest, TheirNumberIsLimited) {
  OutgoingFiles files(2, hours(1));
  auto one = Open(files), two = Open(files);
  ASSERT_TRUE(one.ok() && two.ok());
  const auto third = Open(files);
  EXPECT_EQ(third.status().code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(third.status().reason().name(), "TOO_BUSY");
  EXPECT_EQ(num_open_, 2);
  EXPECT_EQ((*one)->size_bytes(), 4);
  EXPECT_EQ((*one)->Read(9).value(), "part");
  one->reset();
  EXPECT_TRUE(Open(files).ok());
}

TEST_F(OutgoingFilesTest, AFailedOpeningTakesNoPlace) {
  OutgoingFiles files(1, hours(1));
  EXPECT_EQ(files.Open([]() -> OutgoingFiles::Opened { return NotFound("none"); }).status().code(),
            StatusCode::kNotFound);
  EXPECT_THROW((void)files.Open([]() -> OutgoingFiles::Opened { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_TRUE(Open(files).ok());
}

TEST_F(OutgoingFilesTest, AnIdleFileIsEvictedOnlyWhenItsPlaceIsNeeded) {
  OutgoingFiles files(1, std::chrono::nanoseconds(0));
  auto first = Open(files);
  EXPECT_EQ((*first)->Read(9).value(), "part");
  const auto second = Open(files);
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(num_open_, 1) << "its disk space, too, is free at once";
  const auto read = (*first)->Read(9);
  EXPECT_EQ(read.status().code(), StatusCode::kAborted);
  EXPECT_EQ(read.status().reason().name(), "DOWNLOAD_EVICTED");
  first->reset();
  EXPECT_EQ((*second)->Read(9).value(), "part");
}

TEST_F(OutgoingFilesTest, AFileBeingOpenedIsNotIdle) {
  OutgoingFiles files(1, std::chrono::nanoseconds(0));
  const auto outer = files.Open([&]() -> OutgoingFiles::Opened {
    EXPECT_EQ(Open(files).status().reason().name(), "TOO_BUSY");
    return std::unique_ptr<StoreBackup>(std::make_unique<CountedFile>(num_open_));
  });
  EXPECT_TRUE(outer.ok());
}

TEST_F(OutgoingFilesTest, AFileMayOutliveItsRegistry) {
  auto files = std::make_unique<OutgoingFiles>(1, hours(1));
  const auto file = Open(*files);
  files.reset();
  EXPECT_EQ((*file)->Read(9).value(), "part");
}

}  // namespace
}  // namespace dhpmap
