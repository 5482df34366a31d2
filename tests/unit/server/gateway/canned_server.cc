// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/server/gateway/canned_server.h"

#include <grpcpp/generic/async_generic_service.h>

#include <condition_variable>

#include "tests/support/eventually.h"

namespace dhpmap::gateway {
namespace {

grpc::ByteBuffer ToBuffer(const std::string& bytes) {
  const grpc::Slice slice(bytes);
  return {&slice, 1};
}

std::string ToBytes(const grpc::ByteBuffer& buffer) {
  std::vector<grpc::Slice> slices;
  std::string bytes;
  if (!buffer.Dump(&slices).ok()) return bytes;
  for (const auto& slice : slices) bytes.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return bytes;
}

}  // namespace

struct CannedServer::Impl : grpc::CallbackGenericService {
  grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* context) override;

  std::unique_ptr<grpc::Server> server;
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::string, CannedAnswer> answers;
  std::vector<HeardCall> heard;
  int num_cancelled = 0;
};

namespace {

class Reactor final : public grpc::ServerGenericBidiReactor {
 public:
  Reactor(CannedServer::Impl* impl, CannedAnswer answer, HeardCall call)
      : impl_(*impl), answer_(std::move(answer)), call_(std::move(call)) {
    StartRead(&incoming_);
  }

  void OnReadDone(bool ok) override {
    if (!ok) {
      read_ended_ = true;
      if (answer_.at_end) return WriteNext();
      if (!answering_) End();
      return;
    }
    call_.requests.push_back(ToBytes(incoming_));
    if (answer_.hang) return Heard();
    if (answer_.acknowledge) {
      answer_.messages = {answer_.acknowledge(call_.requests.back())};
      next_ = 0;
    } else if (call_.requests.size() > 1 || answer_.at_end) {
      return StartRead(&incoming_);
    }
    WriteNext();
  }

  void OnWriteDone(bool ok) override {
    if (!ok) return End();
    WriteNext();
  }

  void OnCancel() override {
    {
      const std::lock_guard lock(impl_.mutex);
      ++impl_.num_cancelled;
      impl_.changed.notify_all();
    }
    if (answer_.hang) End();  // else the read or write under way fails, and ends it
  }

  void OnDone() override { delete this; }

 private:
  void WriteNext() {
    answering_ = next_ < answer_.messages.size();
    if (answering_) {
      outgoing_ = ToBuffer(answer_.messages[next_++]);
      return StartWrite(&outgoing_);
    }
    if (answer_.acknowledge) return StartRead(&incoming_);
    End();
  }

  void Heard() {
    const std::lock_guard lock(impl_.mutex);
    impl_.heard.push_back(call_);
    impl_.changed.notify_all();
  }

  void End() {
    {
      const std::lock_guard lock(impl_.mutex);
      if (ended_) return;
      ended_ = true;
    }
    if (!answer_.hang) Heard();
    Finish(answer_.status);
  }

  CannedServer::Impl& impl_;
  CannedAnswer answer_;
  HeardCall call_;
  grpc::ByteBuffer incoming_, outgoing_;
  std::size_t next_ = 0;
  bool answering_ = false;
  bool read_ended_ = false;
  bool ended_ = false;
};

}  // namespace

grpc::ServerGenericBidiReactor* CannedServer::Impl::CreateReactor(grpc::GenericCallbackServerContext* context) {
  HeardCall call;
  call.method = context->method();
  call.deadline = context->deadline();
  for (const auto& [key, value] : context->client_metadata()) {
    call.metadata.emplace(std::string(key.data(), key.size()), std::string(value.data(), value.size()));
  }
  CannedAnswer answer{.messages = {""}, .acknowledge = {}, .status = {}, .hang = false};
  {
    const std::lock_guard lock(mutex);
    const auto found = answers.find(call.method.substr(call.method.rfind('/') + 1));
    if (found != answers.end()) answer = found->second;
  }
  return new Reactor(this, std::move(answer), std::move(call));
}

CannedServer::CannedServer() : impl_(std::make_unique<Impl>()) {
  grpc::ServerBuilder builder;
  builder.RegisterCallbackGenericService(impl_.get());
  builder.SetMaxReceiveMessageSize(-1);
  impl_->server = builder.BuildAndStart();
}

CannedServer::~CannedServer() { impl_->server->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(5)); }

std::shared_ptr<grpc::Channel> CannedServer::channel() {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  return impl_->server->InProcessChannel(arguments);
}

void CannedServer::Set(const std::string& method, CannedAnswer answer) {
  const std::lock_guard lock(impl_->mutex);
  impl_->answers[method] = std::move(answer);
}

HeardCall CannedServer::WaitForCall(std::size_t number) {
  std::unique_lock lock(impl_->mutex);
  impl_->changed.wait_for(lock, testing::kPatience, [&] { return impl_->heard.size() >= number; });
  return impl_->heard.empty() ? HeardCall{} : impl_->heard.back();
}

bool CannedServer::WaitForCancel() {
  std::unique_lock lock(impl_->mutex);
  return impl_->changed.wait_for(lock, testing::kPatience, [&] { return impl_->num_cancelled > 0; });
}

std::size_t CannedServer::num_calls() {
  const std::lock_guard lock(impl_->mutex);
  return impl_->heard.size();
}

}  // namespace dhpmap::gateway
