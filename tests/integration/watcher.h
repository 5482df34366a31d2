// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {

/// Without the fields that only lists contain: box, footprint and support.
inline std::string AsTold(v1::Submap submap) {
  submap.clear_oriented_box();
  submap.clear_footprint();
  submap.clear_support_height_m();
  return submap.SerializeAsString();
}

/// The submaps of a map, by instance id, as a client that has listed them and watches the changes knows them.
class HeldSubmaps {
 public:
  explicit HeldSubmaps(const v1::ListSubmapsResponse& list) : revision_(list.revision()) {
    for (const v1::Submap& submap : list.submaps()) submaps_[submap.instance_id()] = AsTold(submap);
  }

  void Apply(const v1::MapChange& change) {
    for (const v1::SubmapEvent& event : change.submaps()) {
      const bool is_gone = event.kind() == v1::SubmapEvent::REMOVED || event.kind() == v1::SubmapEvent::MERGED;
      if (is_gone) submaps_.erase(event.submap().instance_id());
      else submaps_[event.submap().instance_id()] = AsTold(event.submap());
    }
  }

  [[nodiscard]] std::int64_t revision() const { return revision_; }
  [[nodiscard]] const std::map<std::int64_t, std::string>& submaps() const { return submaps_; }

 private:
  std::int64_t revision_;
  std::map<std::int64_t, std::string> submaps_;
};

inline v1::ListSubmapsResponse ListAll(v1::SubmapService::Stub& submaps, const std::string& map) {
  v1::ListSubmapsRequest request;
  request.set_parent("maps/" + map);
  v1::ListSubmapsResponse response;
  grpc::ClientContext context;
  EXPECT_OK(submaps.ListSubmaps(&context, request, &response));
  return response;
}

inline std::int64_t RevisionOf(const std::string& position) {
  return std::stoll(position.substr(position.find('-') + 1));
}

/// A call of WatchMap. It ends with the destructor, or after a timeout that only a hang exceeds.
class Watcher {
 public:
  Watcher(v1::WatchService::Stub& watches, v1::WatchMapRequest request) {
    if (request.progress_interval_s() == 0) request.set_progress_interval_s(0.5);
    context_.set_deadline(std::chrono::system_clock::now() + kPatience);
    reader_ = watches.WatchMap(&context_, request);
  }
  Watcher(TestServer& server, const std::string& map, std::int64_t start_revision)
      : Watcher(*server.watches, [&] {
          v1::WatchMapRequest request;
          request.set_map("maps/" + map);
          request.set_start_revision(start_revision);
          return request;
        }()) {}
  ~Watcher() { (void)Cancel(); }

  /// False at the end.
  bool Read(v1::WatchMapResponse& message) { return reader_ != nullptr && reader_->Read(&message); }

  /// Applies changes up to the revision. False if the watch ends before.
  bool FollowTo(std::int64_t revision, HeldSubmaps& held) {
    v1::WatchMapResponse message;
    while (position_.empty() || RevisionOf(position_) < revision) {
      if (!Read(message)) return false;
      held.Apply(message.change());
      position_ = message.position();
    }
    return true;
  }
  [[nodiscard]] const std::string& position() const { return position_; }

  /// The status at the end, once all messages are read.
  grpc::Status Finish() {
    v1::WatchMapResponse message;
    while (Read(message)) {
    }
    return reader_ == nullptr ? grpc::Status() : std::exchange(reader_, nullptr)->Finish();
  }
  grpc::Status Cancel() {
    context_.TryCancel();
    return Finish();
  }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<v1::WatchMapResponse>> reader_;
  std::string position_;
};

}  // namespace dhpmap::testing
