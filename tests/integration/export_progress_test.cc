// SPDX-License-Identifier: BSD-3-Clause
// What watchers of a map receive about exports.
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <semaphore>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "tests/integration/test_server.h"
#include "tests/integration/watcher.h"
#include "tests/support/wrapped_store.h"

namespace dhpmap::testing {
namespace {

constexpr int kNumParts = 50;
constexpr std::int64_t kPart_bytes = 1000;
/// More than the windows and buffers on the way to a client that does not read.
constexpr int kEndless = 1'000'000;

/// Each part waits for Let.
class GatedFile final : public StoreBackup {
 public:
  GatedFile(std::counting_semaphore<>& gate, int num_parts) : gate_(gate), num_parts_(num_parts) {}
  [[nodiscard]] std::int64_t size_bytes() const override { return num_parts_ * kPart_bytes; }
  Result<std::string> Read(std::size_t) override {
    if (!gate_.try_acquire_for(kPatience)) return Unavailable("nobody opens the gate");
    return num_read_++ < num_parts_ ? std::string(kPart_bytes, 'x') : std::string();
  }

 private:
  std::counting_semaphore<>& gate_;
  const int num_parts_;
  int num_read_ = 0;
};

/// A memory store whose export files are read part by part.
class GatedStore final : public testing::WrappedStore {
 public:
  /// Allows `num_parts` more parts to be read.
  void Let(int num_parts) { gate_.release(num_parts); }
  /// Of files opened from now on.
  void set_num_parts(int num_parts) { num_parts_ = num_parts; }
  /// Files are never ready: an export waits until its client disconnects.
  void set_never_made() { is_never_made_ = true; }

  Result<std::unique_ptr<StoreBackup>> Backup(const std::stop_token& stop) override { return Make(stop); }
  Result<std::unique_ptr<StoreBackup>> ExportMap(const std::string&, const std::stop_token& stop) override {
    return Make(stop);
  }

 private:
  Result<std::unique_ptr<StoreBackup>> Make(const std::stop_token& stop) {
    if (!is_never_made_) return std::unique_ptr<StoreBackup>(std::make_unique<GatedFile>(gate_, num_parts_));
    std::binary_semaphore gone(0);
    const std::stop_callback on_stop(stop, [&gone] { gone.release(); });
    if (!gone.try_acquire_for(kPatience)) return Unavailable("nobody goes away");
    return Cancelled("its caller has gone");
  }

  std::counting_semaphore<> gate_{0};
  std::atomic<int> num_parts_ = kNumParts;
  std::atomic<bool> is_never_made_ = false;
};

class ExportProgressTest : public ::testing::Test {
 protected:
  using Stage = v1::ExportProgress;
  ExportProgressTest() {
    for (const char* name : {"room", "hall"}) {
      EXPECT_OK(server.Call(&MapStub::CreateMap, CreateRequest(name)));
    }
  }
  ~ExportProgressTest() override { store.Let(10 * kNumParts); }  // so that no thread waits

  /// Has received its starting position; sends no sign of life for minutes.
  std::unique_ptr<Watcher> Watch(const std::string& map) {
    v1::WatchMapRequest request;
    request.set_map("maps/" + map);
    request.set_progress_interval_s(300);
    auto watcher = std::make_unique<Watcher>(*server.watches, request);
    v1::WatchMapResponse message;
    EXPECT_TRUE(watcher->Read(message));
    EXPECT_EQ(message.progress().exports_size(), 0);
    return watcher;
  }
  std::unique_ptr<grpc::ClientReader<v1::ExportMapResponse>> Export(grpc::ClientContext& context) {
    v1::ExportMapRequest request;
    request.set_name("maps/room");
    return server.maps->ExportMap(&context, request);
  }
  /// The first message of this stage with at least so many bytes.
  v1::ExportProgress Await(Watcher& watcher, v1::ExportProgress::Stage stage, std::int64_t least_bytes = 0) {
    while (watcher.Read(last)) {
      ++num_told;
      if (last.progress().exports_size() == 0) continue;
      const v1::ExportProgress& told = last.progress().exports(0);
      if (told.stage() == stage && told.done_bytes() >= least_bytes) return told;
    }
    ADD_FAILURE() << "never told";
    return {};
  }

  GatedStore store;
  TestServer server{store};
  v1::WatchMapResponse last;
  int num_told = 0;
};

TEST_F(ExportProgressTest, AWatcherReceivesStartProgressAndEndOfAnExport) {
  const auto watcher = Watch("room"), other = Watch("hall");
  grpc::ClientContext context;
  const auto reader = Export(context);
  const v1::ExportProgress begun = Await(*watcher, Stage::SENDING);
  EXPECT_EQ(begun.kind(), v1::ExportProgress::MAP_FILE);
  EXPECT_EQ(begun.total_bytes(), kNumParts * kPart_bytes);
  EXPECT_EQ(begun.done_bytes(), 0);
  EXPECT_EQ(last.progress().num_exports(), 1);

  v1::ExportMapResponse part;
  store.Let(2);
  ASSERT_TRUE(reader->Read(&part) && reader->Read(&part));
  const v1::ExportProgress later = Await(*watcher, Stage::SENDING, 2 * kPart_bytes);
  EXPECT_EQ(later.id(), begun.id());
  EXPECT_EQ(later.done_bytes(), 2 * kPart_bytes) << "told though it is no news";
  EXPECT_GT(later.elapsed_s(), begun.elapsed_s());

  num_told = 0;
  store.Let(kNumParts);
  while (reader->Read(&part)) continue;
  EXPECT_OK(reader->Finish());
  const v1::ExportProgress ended = Await(*watcher, Stage::SENT);
  EXPECT_EQ(ended.id(), begun.id());
  EXPECT_EQ(ended.done_bytes(), ended.total_bytes());
  EXPECT_EQ(last.progress().num_exports(), 0);
  EXPECT_LT(num_told, kNumParts - 2) << "not with each part";

  grpc::ClientContext backing_up;
  const auto backup = server.maps->BackupMaps(&backing_up, {});
  EXPECT_EQ(Await(*other, Stage::SENDING).kind(), v1::ExportProgress::BACKUP) << "the first that is of this map, too";
  backing_up.TryCancel();
  EXPECT_EQ(backup->Finish().error_code(), grpc::CANCELLED);
}

TEST_F(ExportProgressTest, AnExportEndsWhenItsClientDisconnects) {
  store.set_num_parts(kEndless);
  const auto watcher = Watch("room");
  grpc::ClientContext context;
  const auto reader = Export(context);
  v1::ExportMapResponse part;
  store.Let(1);
  ASSERT_TRUE(reader->Read(&part));
  const std::int64_t id = Await(*watcher, Stage::SENDING, kPart_bytes).id();
  context.TryCancel();
  EXPECT_EQ(reader->Finish().error_code(), grpc::CANCELLED);
  store.Let(kEndless / 2);  // the server reads on until it notices: the number of parts is open
  const v1::ExportProgress left = Await(*watcher, Stage::CANCELLED);
  EXPECT_EQ(left.id(), id);
  EXPECT_LT(left.done_bytes(), left.total_bytes());
  EXPECT_EQ(last.progress().num_exports(), 0);
}

TEST_F(ExportProgressTest, AnExportEndsWhenItsClientDisconnectsWhileTheServerReadsAhead) {
  store.set_num_parts(kEndless);
  const auto watcher = Watch("room");
  grpc::ClientContext context;
  const auto reader = Export(context);
  store.Let(kNumParts);  // they fit into the buffers on the way, unread
  (void)Await(*watcher, Stage::SENDING, kNumParts * kPart_bytes);
  context.TryCancel();
  EXPECT_EQ(reader->Finish().error_code(), grpc::CANCELLED);
  store.Let(kEndless / 2);
  EXPECT_LT(Await(*watcher, Stage::CANCELLED).done_bytes(), kEndless * kPart_bytes);
}

TEST_F(ExportProgressTest, AnExportEndsWhenItsClientDisconnectsBeforeTheFileIsReady) {
  store.set_never_made();
  const auto watcher = Watch("room");
  grpc::ClientContext context;
  const auto reader = Export(context);
  const v1::ExportProgress prepared = Await(*watcher, Stage::PREPARING);
  EXPECT_EQ(prepared.total_bytes(), 0);
  context.TryCancel();
  EXPECT_EQ(reader->Finish().error_code(), grpc::CANCELLED);
  EXPECT_EQ(Await(*watcher, Stage::CANCELLED).id(), prepared.id());
}

TEST_F(ExportProgressTest, ALaterWatcherReceivesRunningExportsOnly) {
  v1::ExportMapResponse part;
  {
    grpc::ClientContext context;
    const auto ended = Export(context);
    store.Let(kNumParts + 1);
    while (ended->Read(&part)) continue;
    EXPECT_OK(ended->Finish());
  }
  grpc::ClientContext context;
  const auto reader = Export(context);
  store.Let(1);
  ASSERT_TRUE(reader->Read(&part));
  const auto watcher = Watch("room");
  const v1::ExportProgress told = Await(*watcher, Stage::SENDING);
  EXPECT_EQ(num_told, 1);
  EXPECT_EQ(last.progress().exports_size(), 1) << last.ShortDebugString();
  EXPECT_EQ(told.id(), 2);
  context.TryCancel();
  (void)reader->Finish();
}

}  // namespace
}  // namespace dhpmap::testing
