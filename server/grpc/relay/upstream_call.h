// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/client_callback.h>

#include <memory>
#include <string>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// Who hears of an UpstreamCall, on gRPC's threads: one OnSent a Send, one OnAnswer a ReadNext or nothing more, and at
/// the very end one OnEnd.
class UpstreamListener {
 public:
  virtual ~UpstreamListener() = default;
  virtual void OnSent() = 0;
  virtual void OnAnswer(grpc::ByteBuffer answer) = 0;
  /// The call's context has the metadata.
  virtual void OnEnd(const grpc::Status& status) = 0;
};

/// The far side of a call that is passed on, in any of the four shapes: bytes to another server and back. It begins to
/// read as soon as it starts. Keeps itself until it has ended. Thread-safe, but one Send at a time.
class UpstreamCall final : public grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>,
                           public std::enable_shared_from_this<UpstreamCall> {
 public:
  UpstreamCall(std::shared_ptr<UpstreamListener> listener, std::shared_ptr<grpc::Channel> channel)
      : listener_(std::move(listener)), channel_(std::move(channel)) {}

  /// To be filled before Start; its metadata may be read in OnAnswer and OnEnd.
  grpc::ClientContext& context() { return context_; }
  /// As long as the call goes on.
  void Keep(std::shared_ptr<const void> kept) { kept_ = std::move(kept); }

  void Start(const std::string& path);
  /// False: the call is ending, and the message is as it was.
  bool Send(grpc::ByteBuffer& message, bool is_last) DHPMAP_EXCLUDES(mutex_);
  /// Half-closes; when no Send is under way, and none was the last.
  void SendEnd() DHPMAP_EXCLUDES(mutex_);
  /// Once an answer has been dealt with.
  void ReadNext() { StartRead(&incoming_); }
  /// It ends soon, whatever it waits for.
  void Cancel() { context_.TryCancel(); }

  void OnReadInitialMetadataDone(bool ok) override;
  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;

 private:
  void Tell();

  std::shared_ptr<UpstreamListener> listener_;
  std::shared_ptr<grpc::Channel> channel_;
  std::shared_ptr<const void> kept_;
  grpc::ClientContext context_;
  grpc::ByteBuffer incoming_, outgoing_;
  std::shared_ptr<UpstreamCall> self_;
  Mutex mutex_;
  bool has_head_ DHPMAP_GUARDED_BY(mutex_) = false;        ///< the initial metadata; answers are told after it
  bool is_answer_kept_ DHPMAP_GUARDED_BY(mutex_) = false;  ///< in `incoming_`, until that is there
  bool is_open_ DHPMAP_GUARDED_BY(mutex_) = false;  ///< and held, so that sends may start outside of gRPC's reactions
};

}  // namespace dhpmap
