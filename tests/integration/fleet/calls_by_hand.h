// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/eventually.h"

namespace dhpmap::testing {

inline grpc::ByteBuffer BytesOf(const std::string& text) {
  const grpc::Slice slice(text);
  return {&slice, 1};
}

/// What one thread waits for and another one brings.
template <typename T>
class Events {
 public:
  void Add(T event) {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(event));
    has_some_.notify_all();
  }
  std::optional<T> Next() {
    std::unique_lock lock(mutex_);
    if (!has_some_.wait_for(lock, kPatience, [&] { return !events_.empty(); })) return std::nullopt;
    T next = std::move(events_.front());
    events_.pop_front();
    return next;
  }
  bool IsTrueNext() { return Next().value_or(false); }

 private:
  std::mutex mutex_;
  std::condition_variable has_some_;
  std::deque<T> events_;
};

/// A client's call in bytes, of any method. Each operation blocks; one thread may write while another one reads.
class CallByHand final : public grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  using Fill = std::function<void(grpc::ClientContext&)>;

  CallByHand(const std::shared_ptr<grpc::Channel>& channel, const std::string& path, const Fill& fill = {}) {
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(10));
    if (fill) fill(context);
    grpc::GenericStub(channel).PrepareBidiStreamingCall(&context, path, {}, this);
    AddHold();
    StartCall();
  }
  ~CallByHand() override {
    context.TryCancel();
    (void)Finish();
  }
  bool Write(const std::string& message) {
    outgoing_ = BytesOf(message);
    StartWrite(&outgoing_);
    return written_.IsTrueNext();
  }
  bool WriteLast(const std::string& message) {
    outgoing_ = BytesOf(message);
    StartWriteLast(&outgoing_, grpc::WriteOptions());
    return written_.IsTrueNext();
  }
  /// The size of the next answer; nothing at the end.
  std::optional<std::size_t> Read() {
    StartRead(&incoming_);
    if (!read_.IsTrueNext()) return std::nullopt;
    return incoming_.Length();
  }
  grpc::Status Finish() {
    if (!status_) {
      RemoveHold();
      status_ = done_.Next().value_or(grpc::Status(grpc::UNKNOWN, "the call hangs"));
    }
    return *status_;
  }

  void OnWriteDone(bool ok) override { written_.Add(ok); }
  void OnReadDone(bool ok) override { read_.Add(ok); }
  void OnDone(const grpc::Status& status) override { done_.Add(status); }

  grpc::ClientContext context;

 private:
  grpc::ByteBuffer outgoing_, incoming_;
  Events<bool> written_, read_;
  Events<grpc::Status> done_;
  std::optional<grpc::Status> status_;
};

/// A call as it arrives at an OwnerByHand, which does with it what the test says and nothing else. Operations as above.
class HeldCall final : public grpc::ServerGenericBidiReactor {
 public:
  explicit HeldCall(grpc::GenericCallbackServerContext* its) : context(its), deadline(its->deadline()) {
    for (const auto& [key, value] : its->client_metadata()) {
      metadata.emplace(std::string(key.data(), key.size()), std::string(value.data(), value.size()));
    }
  }
  std::optional<std::size_t> Read() {
    if (!Begin([&] { StartRead(&incoming_); }) || !read_.IsTrueNext()) return std::nullopt;
    return incoming_.Length();
  }
  bool Write(const std::string& message) {
    outgoing_ = BytesOf(message);
    return Begin([&] { StartWrite(&outgoing_); }) && written_.IsTrueNext();
  }
  void End(const grpc::Status& status) {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(is_finished_, true)) Finish(status);
  }
  bool IsCancelledSoon() { return cancelled_.IsTrueNext(); }

  void OnReadDone(bool ok) override { read_.Add(ok); }
  void OnWriteDone(bool ok) override { written_.Add(ok); }
  void OnCancel() override {
    cancelled_.Add(true);
    End(grpc::Status::CANCELLED);
  }
  void OnDone() override { done_.Add(true); }
  bool IsDoneSoon() { return done_.IsTrueNext(); }

  grpc::GenericCallbackServerContext* const context;  ///< until it is done
  const std::chrono::system_clock::time_point deadline;
  std::multimap<std::string, std::string> metadata;

 private:
  bool Begin(const std::function<void()>& start) {
    const std::lock_guard lock(mutex_);
    if (!is_finished_) start();
    return !is_finished_;
  }
  std::mutex mutex_;
  bool is_finished_ = false;
  grpc::ByteBuffer incoming_, outgoing_;
  Events<bool> read_, written_, cancelled_, done_;
};

/// Plays the server that owns a map: takes calls of any method, in bytes.
class OwnerByHand final : public grpc::CallbackGenericService {
 public:
  OwnerByHand() {
    grpc::ServerBuilder builder;
    builder.SetMaxReceiveMessageSize(-1);
    builder.AddChannelArgument(GRPC_ARG_HTTP2_BDP_PROBE, 0);  // as our servers do
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterCallbackGenericService(this);
    server_ = builder.BuildAndStart();
  }
  ~OwnerByHand() override { Die(); }

  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  /// The next call that arrives.
  HeldCall& Accept() { return *arrived_.Next().value(); }
  /// Cuts all connections.
  void Die() {
    server_->Shutdown(std::chrono::system_clock::now());
    server_->Wait();
  }

  grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* context) override {
    const std::lock_guard lock(mutex_);
    calls_.push_back(std::make_unique<HeldCall>(context));
    arrived_.Add(calls_.back().get());
    return calls_.back().get();
  }

 private:
  int port_ = 0;
  std::mutex mutex_;
  std::vector<std::unique_ptr<HeldCall>> calls_;
  Events<HeldCall*> arrived_;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace dhpmap::testing
