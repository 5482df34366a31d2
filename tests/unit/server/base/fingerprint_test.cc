// SPDX-License-Identifier: BSD-3-Clause
#include "server/base/fingerprint.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(Fingerprint, EqualsThePublishedValues) {  // the published values of FNV-1a
  EXPECT_EQ(Fingerprint(""), 0xcbf29ce484222325u);
  EXPECT_EQ(Fingerprint("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(Fingerprint("foobar"), 0x85944171f73967e8u);
}

}  // namespace
}  // namespace dhpmap
