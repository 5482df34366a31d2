// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "clients/cpp/calls/caller.h"
#include "dhpmap/feed.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "mapping/base/mutex.h"

namespace dhpmap::client {

/// Callbacks of a stream of frames. They run on a thread of the stream, one at a time, and not after its destruction.
/// Each may be empty.
struct FrameListener {
  std::function<void(const v1::IntegrateFramesResponse&)> on_answer;  ///< called for each answer
  std::function<bool(const Status& why)> goes_on;  ///< called after a lost connection; false: give up
};

/// A session of frames. Sends them in order, keeps each until it is stored, and sends it again after a lost connection.
/// A session without a name ends with its connection. One thread pushes; any thread may call the const methods. One
/// thread of its own holds the connection, and one more per connection sends.
class FrameStream {
 public:
  FrameStream(std::shared_ptr<Caller> caller, const std::string& map, const FeedOptions& options,
              FrameListener listener = {});
  /// Closes the connection at once; frames that are not stored may be lost.
  ~FrameStream();
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  /// The server's error if it refuses the stream. OK for a session without a name, which has no greeting.
  Status WaitUntilGreeted() DHPMAP_EXCLUDES(mutex_);
  /// Waits for room. Returns the error that has ended the stream.
  Status Push(std::int64_t sequence, v1::Frame frame) DHPMAP_EXCLUDES(mutex_);
  /// Waits until all frames are stored.
  Status Close() DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] FeedState state() const DHPMAP_EXCLUDES(mutex_);
  std::vector<FrameNote> TakeNotes() DHPMAP_EXCLUDES(mutex_);

 private:
  using Request = v1::IntegrateFramesRequest;
  using Response = v1::IntegrateFramesResponse;
  using Stream = grpc::ClientReaderWriterInterface<Request, Response>;

  /// Keeps a connection until the stream is over.
  void Hold();
  /// Waits until `again`, and then for a connection, two seconds at most; less if the feed is abandoned.
  void AwaitConnection(Clock::time_point again) DHPMAP_EXCLUDES(mutex_);
  /// Runs one connection. OK: all frames to be sent are stored.
  Status Exchange();
  Status ReadAll(Stream& stream);
  void WriteAll(Stream& stream, int connection);
  /// The next message to send on a connection; null: there are no more.
  std::shared_ptr<const Request> NextToSend(int connection);
  Status Hear(const Response& answer);
  /// Not OK: the frame was refused for now and is sent again on another connection.
  Status Acknowledge(const Response& answer) DHPMAP_REQUIRES(mutex_);
  void ForgetStored(std::int64_t sequence) DHPMAP_REQUIRES(mutex_);
  void Forget(std::int64_t sequence) DHPMAP_REQUIRES(mutex_);
  void Note(FrameNote note) DHPMAP_REQUIRES(mutex_);
  Status EndOf(const grpc::Status& finished) DHPMAP_EXCLUDES(mutex_);
  /// Waits until is_so(), at most deadline_s after the server's last message. Returns the error that has ended the
  /// stream.
  Status Wait(const std::function<bool()>& is_so, const char* what) DHPMAP_REQUIRES(mutex_);
  bool HasRoom(std::int64_t num_bytes) DHPMAP_REQUIRES(mutex_);

  [[nodiscard]] bool has_name() const { return !options_.session.empty(); }
  /// Whether another connection may succeed.
  [[nodiscard]] bool MayPass(const Status& status) const;

  const std::shared_ptr<Caller> caller_;
  const FeedOptions options_;
  const FrameListener listener_;
  mutable Mutex mutex_;
  CondVar changed_;
  Request greeting_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::int64_t, std::shared_ptr<const Request>> kept_ DHPMAP_GUARDED_BY(mutex_);  // perhaps not stored
  std::int64_t kept_bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::set<std::int64_t> unacknowledged_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<std::int64_t> unsent_ DHPMAP_GUARDED_BY(mutex_);  // on this connection
  int connection_ DHPMAP_GUARDED_BY(mutex_) = 0;               // number of the connection; threads of older ones end
  grpc::ClientContext* context_ DHPMAP_GUARDED_BY(mutex_) = nullptr;
  bool is_greeted_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_flushing_ DHPMAP_GUARDED_BY(mutex_) = false;  // half-closes, because only then the server stores at once
  bool is_closing_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_abandoned_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_over_ DHPMAP_GUARDED_BY(mutex_) = false;
  Status error_ DHPMAP_GUARDED_BY(mutex_);
  Status commit_error_ DHPMAP_GUARDED_BY(mutex_);
  Clock::time_point heard_at_ DHPMAP_GUARDED_BY(mutex_) = Clock::now();
  FeedState state_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<FrameNote> notes_ DHPMAP_GUARDED_BY(mutex_);
  std::thread holder_;
};

}  // namespace dhpmap::client
