// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/calls/caller.h"

#include <grpcpp/create_channel.h>

#include <array>
#include <random>
#include <thread>

#include "clients/cpp/calls/credentials.h"
#include "clients/cpp/calls/error.h"

namespace dhpmap::client {
namespace {

/// Notices a dead or unreachable server, and reconnects soon after it has returned.
grpc::ChannelArguments ChannelOptions() {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetMaxSendMessageSize(-1);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 20'000);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 2'000);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return arguments;
}

/// Null if a key would be sent unencrypted to another machine.
std::shared_ptr<grpc::Channel> ChannelTo(const std::string& address, const ConnectOptions& options) {
  auto credentials = CredentialsFor(address, options);
  return credentials.ok() ? grpc::CreateCustomChannel(address, *credentials, ChannelOptions()) : nullptr;
}

std::string Told(double s) {
  std::string text = std::to_string(s);
  text.erase(text.find_last_not_of('0') + 1);
  return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
}

}  // namespace

Result<std::shared_ptr<Caller>> Caller::Make(const std::string& address, const ConnectOptions& options,
                                             const std::string& told_address) {
  auto credentials = CredentialsFor(address, options);
  if (!credentials.ok()) return credentials.status();
  Result<std::string> token = TokenOf(options);
  if (!token.ok()) return token.status();
  const auto channel = grpc::CreateCustomChannel(address, *credentials, ChannelOptions());
  OwnerRoutes::Dial dial;
  if (options.to_owner) dial = [options](const std::string& owner) { return ChannelTo(owner, options); };
  return std::shared_ptr<Caller>(new Caller(told_address, options, *std::move(token), channel, std::move(dial)));
}

Result<std::shared_ptr<Caller>> Caller::Open(const std::string& address, const ConnectOptions& options) {
  return Make(address, options, "");
}

std::shared_ptr<Caller> Caller::Over(const std::shared_ptr<grpc::Channel>& channel, const ConnectOptions& options) {
  return std::shared_ptr<Caller>(new Caller("", options, options.token, channel, nullptr));
}

Result<std::shared_ptr<Caller>> Caller::Connect(const std::string& address, const ConnectOptions& options) {
  auto caller = Make(address, options, address);
  if (caller.ok() && !(*caller)->AwaitConnection(Clock::now() + Seconds(options.connect_s))) {
    return Error(StatusCode::kUnavailable, "no server answers at " + address + " within connect_s = " +
                                               Told(options.connect_s) + "; is dhpmap-server running there?");
  }
  return caller;
}

Caller::Caller(std::string told_address, ConnectOptions options, std::string token,
               const std::shared_ptr<grpc::Channel>& channel, OwnerRoutes::Dial dial)
    : address_(std::move(told_address)),
      options_(std::move(options)),
      token_(std::move(token)),
      channel_(channel),
      first_(std::make_shared<Stubs>(channel)),
      routes_(std::move(dial)) {}

void Caller::Introduce(grpc::ClientContext& context) const {
  if (!token_.empty()) context.AddMetadata("authorization", "Bearer " + token_);
}

bool Caller::AwaitConnection(Clock::time_point end) const { return channel_->WaitForConnected(GrpcTime(end)); }

void Caller::Pause(Clock::time_point end) const {
  if (AwaitConnection(end)) std::this_thread::sleep_until(end);
}

Status Caller::StatusOf(const grpc::Status& status) const { return client::StatusOf(status, address_); }

std::shared_ptr<Stubs> Caller::NearestTo(const std::string& map) const {
  constexpr auto kSoon = std::chrono::milliseconds(250);
  auto owner = routes_.To(map, Clock::now() + kSoon);
  return owner != nullptr ? owner : first_;
}

void Caller::Heard(const std::string& map, const grpc::ClientContext& context, const grpc::Status& status) const {
  if (status.error_code() == grpc::UNAVAILABLE) routes_.Forget(map);
  else routes_.Learn(map, context);
}

Status Caller::Attempt(const std::function<grpc::Status(Stubs&, grpc::ClientContext*)>& call, const std::string& map,
                       double deadline_s, Again again) const {
  const double most_s = DeadlineOr(deadline_s);
  const Clock::time_point end = Clock::now() + Seconds(most_s);
  for (Pauses pauses;;) {
    grpc::ClientContext context;
    Introduce(context);
    context.set_deadline(GrpcTime(end));
    const auto owner = routes_.To(map);
    const grpc::Status outcome = call(owner != nullptr ? *owner : *first_, &context);
    Heard(map, context, outcome);
    Status status = StatusOf(outcome);
    if (owner != nullptr && status.reason == "NOT_OWNER") continue;  // not its map: ask the first server
    if (status.code == StatusCode::kDeadlineExceeded && status.reason.empty()) {
      status.message = "took longer than deadline_s = " + Told(most_s);
    }
    if (again == Again::kNo || !IsPassing(status)) return status;
    const Clock::duration pause = pauses.Next();
    if (Clock::now() + pause >= end) return status;
    Pause(Clock::now() + pause);
  }
}

std::string NewRequestId() {
  std::random_device random;
  std::array<unsigned, 4> words{};
  for (unsigned& word : words) word = random();
  words[1] = (words[1] & 0xffff0fffU) | 0x4000U;      // version 4: random
  words[2] = (words[2] & 0x3fffffffU) | 0x80000000U;  // variant of RFC 4122
  std::string id;
  for (std::size_t i = 0; i < 32; ++i) {
    if (i == 8 || i == 12 || i == 16 || i == 20) id += '-';
    id += "0123456789abcdef"[(words[i / 8] >> (28 - 4 * (i % 8))) & 0xfU];
  }
  return id;
}

}  // namespace dhpmap::client
