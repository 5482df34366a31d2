// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/running_exports.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

using Opened = RunningExports::Opened;

/// Three parts of 4 bytes, then the end or an error.
class ThreeParts final : public StoreBackup {
 public:
  explicit ThreeParts(Status end) : end_(std::move(end)) {}
  [[nodiscard]] std::int64_t size_bytes() const override { return 12; }
  Result<std::string> Read(std::size_t) override {
    if (num_read_ < 3) return ++num_read_, std::string("part");
    if (end_.ok()) return std::string();
    return Status(end_.code(), end_.message());
  }

 private:
  int num_read_ = 0;
  Status end_;
};

class RunningExportsTest : public ::testing::Test {
 protected:
  std::unique_ptr<StoreBackup> Open(const std::string& map, ExportKind kind = ExportKind::kMapFile,
                                    const Status& end = Status::Ok()) {
    Opened opened = exports_->Open(
        kind, map, [&]() -> Opened { return std::unique_ptr<StoreBackup>(std::make_unique<ThreeParts>(end)); });
    EXPECT_TRUE(opened.ok());
    return std::move(opened).value();
  }
  /// The news of a map since the last call.
  ExportNews Ask(const std::string& map = "room") {
    ExportNews news = exports_->Of(map, asked_);
    asked_ = news.number;
    return news;
  }

  std::shared_ptr<RunningExports> exports_ = RunningExports::Create();
  std::uint64_t asked_ = 0;
};

TEST_F(RunningExportsTest, AnExportRunsFromItsOpeningToItsLastByte) {
  EXPECT_FALSE(Ask().has_changed);
  auto opened = exports_->Open(ExportKind::kMapFile, "room", [&]() -> Opened {
    const ExportNews news = Ask();
    EXPECT_TRUE(news.has_changed);
    EXPECT_EQ(news.exports.at(0).stage, ExportStage::kPreparing);
    EXPECT_EQ(news.exports.at(0).total_bytes, 0);
    return std::unique_ptr<StoreBackup>(std::make_unique<ThreeParts>(Status::Ok()));
  });
  ExportNews news = Ask();
  EXPECT_TRUE(news.has_changed);
  EXPECT_EQ(news.exports.at(0).stage, ExportStage::kSending);
  EXPECT_EQ(news.exports.at(0).total_bytes, 12);
  const std::int64_t id = news.exports.at(0).id;
  for (int n = 1; n <= 3; ++n) {
    EXPECT_EQ((*opened)->Read(99).value(), "part");
    const double elapsed_s = news.exports.at(0).elapsed_s;
    news = Ask();
    EXPECT_FALSE(news.has_changed) << "bytes are no news, but are there for who looks";
    EXPECT_EQ(news.exports.at(0).done_bytes, 4 * n);
    EXPECT_GE(news.exports.at(0).elapsed_s, elapsed_s);
    EXPECT_EQ(news.num_running, 1u);
  }
  EXPECT_EQ((*opened)->Read(99).value(), "");
  news = Ask();
  EXPECT_TRUE(news.has_changed);
  EXPECT_EQ(news.num_running, 0u);
  ASSERT_EQ(news.exports.size(), 1u);
  EXPECT_EQ(news.exports[0].stage, ExportStage::kSent);
  EXPECT_EQ(news.exports[0].id, id);
  EXPECT_EQ(news.exports[0].done_bytes, 12);
  EXPECT_GT(news.exports[0].elapsed_s, 0);
  opened->reset();
  news = Ask();
  EXPECT_FALSE(news.has_changed) << "an end is told once";
  EXPECT_TRUE(news.exports.empty());
}

TEST_F(RunningExportsTest, AReleasedExportIsCancelledAndAnUnreadableOneFails) {
  auto left = Open("room"), failed = Open("room", ExportKind::kMapFile, DataLoss("torn"));
  (void)Ask();
  (void)left->Read(99);
  left = nullptr;
  ExportNews news = Ask();
  EXPECT_EQ(news.exports.at(0).stage, ExportStage::kLeft);
  EXPECT_EQ(news.exports.at(0).done_bytes, 4);
  EXPECT_EQ(news.num_running, 1u);
  for (int n = 0; n < 3; ++n) (void)failed->Read(99);
  EXPECT_EQ(failed->Read(99).status().code(), StatusCode::kDataLoss);
  news = Ask();
  EXPECT_EQ(news.exports.at(0).stage, ExportStage::kFailed);
  EXPECT_EQ(news.num_running, 0u);
}

TEST_F(RunningExportsTest, AnExportThatCannotBeOpenedEndsAtOnce) {
  const auto stage_after = [this](const std::function<Opened()>& open) {
    (void)exports_->Open(ExportKind::kMapFile, "room", open);
    const ExportNews news = Ask();
    EXPECT_EQ(news.num_running, 0u);
    return news.exports.at(0).stage;
  };
  EXPECT_EQ(stage_after([]() -> Opened { return Cancelled("its caller has gone"); }), ExportStage::kLeft);
  EXPECT_EQ(stage_after([]() -> Opened { return ResourceExhausted("the disk is full"); }), ExportStage::kFailed);
  EXPECT_THROW(stage_after([]() -> Opened { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_EQ(Ask().exports.at(0).stage, ExportStage::kFailed);
  EXPECT_EQ(exports_->Open(ExportKind::kMapFile, "room", []() -> Opened { return NotFound("none"); }).status().code(),
            StatusCode::kNotFound);
  EXPECT_TRUE(Ask().exports.empty()) << "nobody follows a map that is not there";
}

TEST_F(RunningExportsTest, ExportsAreReportedToTheirMapsWatchersAndBackupsToAll) {
  const auto of_room = Open("room"), of_all = Open("", ExportKind::kBackup);
  const ExportNews hall = exports_->Of("hall", 0);
  ASSERT_EQ(hall.exports.size(), 1u);
  EXPECT_EQ(hall.exports[0].kind, ExportKind::kBackup);
  EXPECT_EQ(exports_->Of("room", 0).exports.size(), 2u);
  EXPECT_FALSE(exports_->Of("room", exports_->number()).has_changed);
  EXPECT_EQ(exports_->Of("room", exports_->number()).num_running, 2u) << "told to who comes later, too";
}

TEST_F(RunningExportsTest, ReportedAndKeptExportsAreLimited) {
  constexpr std::size_t kMany = RunningExports::kMaxEnded + 10;
  std::vector<std::unique_ptr<StoreBackup>> files;
  for (std::size_t n = 0; n < kMany; ++n) files.push_back(Open("room"));
  ExportNews news = Ask();
  EXPECT_EQ(news.num_running, kMany);
  ASSERT_EQ(news.exports.size(), RunningExports::kMaxTold);
  EXPECT_EQ(news.exports.front().id, 1) << "the oldest";
  files.clear();
  news = Ask();
  EXPECT_EQ(news.num_running, 0u);
  ASSERT_EQ(news.exports.size(), RunningExports::kMaxTold);
  EXPECT_EQ(news.exports.back().id, static_cast<std::int64_t>(kMany)) << "the newest";
  const auto other = Open("hall");
  EXPECT_FALSE(Ask().has_changed);
}

TEST_F(RunningExportsTest, AFileMayOutliveItsRegistry) {
  const auto file = Open("room");
  exports_ = nullptr;
  EXPECT_EQ(file->Read(9).value(), "part");
}

}  // namespace
}  // namespace dhpmap
