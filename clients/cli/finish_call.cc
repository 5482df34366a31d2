// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/finish_call.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <iostream>
#include <optional>
#include <thread>

#include "clients/cli/text_table.h"
#include "clients/command_line/terminal_line.h"
#include "clients/cpp/calls/error.h"

namespace dhpmap {
namespace {

constexpr std::chrono::milliseconds kLookAgain{100};
/// Longest wait for the watch that reports progress.
constexpr std::chrono::seconds kWatchBegins{2};

std::atomic<bool> g_is_finish_interrupted = false;

void OnFinishInterrupt(int) {
  g_is_finish_interrupted = true;
  std::signal(SIGINT, SIG_DFL);
}

/// Reads progress from WatchMap while a map is being finished, until destruction.
class FinishWatch {
 public:
  FinishWatch(client::Caller& caller, const std::string& map,
              std::function<void(const v1::FinishProgress&)> on_progress)
      : on_progress_(std::move(on_progress)) {
    v1::WatchMapRequest request;
    request.set_map(map);
    request.set_progress_interval_s(0.5);
    messages_ = caller.Read(&v1::WatchService::Stub::WatchMap, request);
    thread_ = std::thread([this] { Read(); });
    begun_.get_future().wait_for(kWatchBegins);
  }
  ~FinishWatch() {
    messages_->Cancel();
    thread_.join();
  }
  FinishWatch(const FinishWatch&) = delete;
  FinishWatch& operator=(const FinishWatch&) = delete;

 private:
  void Read() {
    v1::WatchMapResponse message;
    bool has_begun = false;
    while (messages_->Next(message)) {
      if (!has_begun) begun_.set_value();
      has_begun = true;
      if (message.progress().has_finishing()) on_progress_(message.progress().finishing());
    }
    if (!has_begun) begun_.set_value();
  }

  const std::function<void(const v1::FinishProgress&)> on_progress_;
  std::unique_ptr<client::Parts<v1::WatchMapResponse>> messages_;
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

client::Result<v1::FinishMappingResponse> CallFinish(client::Caller& caller, const std::string& map,
                                                     const FinishListener& listener) {
  std::optional<FinishWatch> watch;
  if (listener.on_progress) watch.emplace(caller, map, listener.on_progress);
  grpc::ClientContext context;
  caller.Introduce(context);
  v1::FinishMappingRequest request;
  request.set_map(map);
  v1::FinishMappingResponse response;
  auto call = std::async(std::launch::async, [&] {
    return caller.stub<v1::MappingService::Stub>().FinishMapping(&context, request, &response);
  });
  while (call.wait_for(kLookAgain) != std::future_status::ready) {
    if (listener.is_interrupted && listener.is_interrupted()) context.TryCancel();
  }
  client::Status status = caller.StatusOf(call.get());
  if (!status.ok()) return status;
  return response;
}

client::Result<v1::FinishMappingResponse> FinishAndTell(client::Caller& caller, const std::string& map) {
  g_is_finish_interrupted = false;
  const auto handler_before = std::signal(SIGINT, OnFinishInterrupt);
  std::atomic<v1::FinishProgress::Stage> told = v1::FinishProgress::STAGE_UNSPECIFIED;
  TerminalLine line;  // used on the listener's thread until the call ends
  const FinishListener listener{.on_progress =
                                    [&](const v1::FinishProgress& progress) {
                                      const bool is_new = told.exchange(progress.stage()) != progress.stage();
                                      const std::string text = map + " " + TextOf(progress.stage()) + ", after " +
                                                               Fixed(progress.elapsed_s(), 1) + " s";
                                      line.Draw(text);
                                      if (is_new && !line.is_terminal()) std::cerr << text << "\n";
                                    },
                                .is_interrupted = [] { return g_is_finish_interrupted.load(); }};
  client::Result<v1::FinishMappingResponse> finished = CallFinish(caller, map, listener);
  line.Clear();
  std::signal(SIGINT, handler_before);
  if (finished.status().code != client::StatusCode::kCancelled) return finished;
  if (!g_is_finish_interrupted) {
    return client::Error(client::StatusCode::kUnavailable, finished.status().message);
  }
  const bool is_too_late = told == v1::FinishProgress::STORING;
  std::cerr << "dhpmap: interrupted: " << map
            << (is_too_late ? " was being stored already, and is finished\n" : " is as it was before\n");
  return finished;
}

}  // namespace dhpmap
