// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/server_process.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// A server for all cases of a suite, with a map `room` of six rendered frames and true labels.
class MappedRoom : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    temp_ = std::make_unique<TempDir>();
    WriteRenderedDataset(temp_->path() / "dataset", 6);
    server_ = std::make_unique<ServerProcess>(temp_->path(), temp_->path() / "maps.db");
    ASSERT_TRUE(server_->is_serving()) << server_->process().Stderr();
    const Outcome mapped =
        server_->Dhpmap({"map", (temp_->path() / "dataset").string(), "--map", "room", "--labels", "groundtruth"});
    ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
  }
  static void TearDownTestSuite() {
    server_.reset();
    temp_.reset();
  }

  inline static std::unique_ptr<TempDir> temp_;
  inline static std::unique_ptr<ServerProcess> server_;
};

}  // namespace dhpmap::testing
