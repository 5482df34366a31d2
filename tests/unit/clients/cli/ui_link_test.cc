// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/ui_link.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(UiLink, IsOfTheHostOfTheGrpcDoor) {
  EXPECT_EQ(HttpOf("127.0.0.1:50051"), "http://127.0.0.1:8080");
  EXPECT_EQ(HttpOf("robot.local"), "http://robot.local:8080");
  EXPECT_EQ(HttpOf("dns:///robot:7000"), "http://robot:8080");
  EXPECT_EQ(HttpOf("[::1]:50051"), "http://[::1]:8080");
  EXPECT_EQ(HttpOf("unix:/run/dhpmap.sock"), "http://127.0.0.1:8080");
  EXPECT_EQ(HttpOf(""), "http://127.0.0.1:8080");
}

TEST(UiLink, NamesTheMapUnlessNoneIsWanted) {
  EXPECT_EQ(UiLink("http://robot:8080", "office"), "http://robot:8080/ui/#map=office");
  EXPECT_EQ(UiLink("https://robot/", "maps/office"), "https://robot/ui/#map=office");
  EXPECT_EQ(UiLink("127.0.0.1:9000", ""), "http://127.0.0.1:9000/ui/");
}

}  // namespace
}  // namespace dhpmap
