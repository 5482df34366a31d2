// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/loaded/library.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "mapping/loaded/cloud_files.h"

namespace dhpmap {
namespace {

TEST(LoadSymbol, ALibraryThatIsNotThereIsUnavailable) {
  const auto symbol = LoadSymbol("libdhpmap_nothing.so", "anything");
  EXPECT_EQ(symbol.status().code(), StatusCode::kUnavailable);
  EXPECT_NE(symbol.status().message().find("libdhpmap_nothing.so"), std::string::npos);
}

TEST(LoadSymbol, WithoutFileDescriptorsItIsTriedAgain) {
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
  rlimit none = limit;
  none.rlim_cur = 0;
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  const auto failed = LoadCloudFiles();
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
  EXPECT_EQ(failed.status().code(), StatusCode::kUnavailable);
  EXPECT_TRUE(LoadCloudFiles().ok()) << LoadCloudFiles().status().ToString();
}

TEST(LoadSymbol, ALibraryOfAnotherVersionIsInternal) {
  EXPECT_EQ(LoadSymbol("libdhpmap_pcl.so", "of_another_version").status().code(), StatusCode::kInternal);
}

}  // namespace
}  // namespace dhpmap
