// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/finish_call.h"

#include <grpcpp/client_context.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <iostream>
#include <optional>
#include <thread>

#include "clients/cli/text_table.h"
#include "clients/command_line/terminal_line.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "dhpmap/v1/watch_service.grpc.pb.h"

namespace dhpmap {
namespace {

constexpr std::chrono::milliseconds kLookAgain{100};
/// The watch that tells of it begins first; longer than that nobody waits for it.
constexpr std::chrono::seconds kWatchBegins{2};

std::atomic<bool> g_is_finish_interrupted = false;

void OnFinishInterrupt(int) {
  g_is_finish_interrupted = true;
  std::signal(SIGINT, SIG_DFL);
}

/// Reads what WatchMap says of a map that is being finished, until the end of its life.
class FinishWatch {
 public:
  FinishWatch(const std::shared_ptr<grpc::Channel>& channel, const std::string& map,
              std::function<void(const v1::FinishProgress&)> on_progress)
      : stub_(v1::WatchService::NewStub(channel)), on_progress_(std::move(on_progress)) {
    request_.set_map(map);
    request_.set_progress_interval_s(0.5);
    thread_ = std::thread([this] { Read(); });
    begun_.get_future().wait_for(kWatchBegins);
  }
  ~FinishWatch() {
    context_.TryCancel();
    thread_.join();
  }
  FinishWatch(const FinishWatch&) = delete;
  FinishWatch& operator=(const FinishWatch&) = delete;

 private:
  void Read() {
    const auto stream = stub_->WatchMap(&context_, request_);
    v1::WatchMapResponse message;
    bool has_begun = false;
    while (stream->Read(&message)) {
      if (!has_begun) begun_.set_value();
      has_begun = true;
      if (message.progress().has_finishing()) on_progress_(message.progress().finishing());
    }
    if (!has_begun) begun_.set_value();
    (void)stream->Finish();
  }

  const std::unique_ptr<v1::WatchService::Stub> stub_;
  const std::function<void(const v1::FinishProgress&)> on_progress_;
  v1::WatchMapRequest request_;
  grpc::ClientContext context_;
  std::promise<void> begun_;
  std::thread thread_;
};

const char* TextOf(v1::FinishProgress::Stage stage) {
  switch (stage) {
    case v1::FinishProgress::WAITING: return "waits for frames and edits that came before";
    case v1::FinishProgress::REFINING: return "is refined";
    case v1::FinishProgress::STORING: return "is stored";
    default: return "is being finished";
  }
}

}  // namespace

grpc::Status CallFinish(const std::shared_ptr<grpc::Channel>& channel, const std::string& map,
                        const FinishListener& listener, v1::FinishMappingResponse& response) {
  std::optional<FinishWatch> watch;
  if (listener.on_progress) watch.emplace(channel, map, listener.on_progress);
  const auto stub = v1::MappingService::NewStub(channel);
  grpc::ClientContext context;
  v1::FinishMappingRequest request;
  request.set_map(map);
  auto call = std::async(std::launch::async, [&] { return stub->FinishMapping(&context, request, &response); });
  while (call.wait_for(kLookAgain) != std::future_status::ready) {
    if (listener.is_interrupted && listener.is_interrupted()) context.TryCancel();
  }
  return call.get();
}

grpc::Status FinishAndTell(const std::shared_ptr<grpc::Channel>& channel, const std::string& map,
                           v1::FinishMappingResponse& response) {
  g_is_finish_interrupted = false;
  const auto handler_before = std::signal(SIGINT, OnFinishInterrupt);
  std::atomic<v1::FinishProgress::Stage> told = v1::FinishProgress::STAGE_UNSPECIFIED;
  TerminalLine line;  // of the listener's thread, until the call is over
  const FinishListener listener{.on_progress =
                                    [&](const v1::FinishProgress& progress) {
                                      const bool is_new = told.exchange(progress.stage()) != progress.stage();
                                      const std::string text = map + " " + TextOf(progress.stage()) + ", after " +
                                                               Fixed(progress.elapsed_s(), 1) + " s";
                                      line.Draw(text);
                                      if (is_new && !line.is_terminal()) std::cerr << text << "\n";
                                    },
                                .is_interrupted = [] { return g_is_finish_interrupted.load(); }};
  const grpc::Status status = CallFinish(channel, map, listener, response);
  line.Clear();
  std::signal(SIGINT, handler_before);
  if (status.error_code() != grpc::StatusCode::CANCELLED) return status;
  if (!g_is_finish_interrupted) return {grpc::StatusCode::UNAVAILABLE, status.error_message()};
  const bool is_too_late = told == v1::FinishProgress::STORING;
  std::cerr << "dhpmap: interrupted: " << map
            << (is_too_late ? " was being stored already, and is finished\n" : " is as it was before\n");
  return status;
}

}  // namespace dhpmap
