// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/attacks/unfinished_loads.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "tests/rig/at_once.h"
#include "tests/rig/attacks/raw_grpc_call.h"
#include "tests/rig/server_under_test.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {
namespace {

/// From its beginning until all of a load goes.
constexpr std::chrono::seconds kHeld{8};

std::string FramesPath(const Target& target) { return "/v1/maps/" + target.map_id + ":integrateFrames"; }

/// A line of so many bytes or a few more. The pose is missing, so that nothing of it is fused.
std::string LargeLine(const std::string& session, std::size_t num_bytes) {
  constexpr const char kPoint[] = "0.12345,1.23456,2.34567,";
  std::string line = R"({"session":")" + session + R"(","sequence":1,"frame":{"lidar":{"packedPointsM":[)";
  line.reserve(num_bytes + 64);
  while (line.size() < num_bytes) line += kPoint;
  line.pop_back();
  return line + "]}}}\n";
}

/// Refused for what it is, or for want of room.
bool IsTypedRefusal(const http::HttpAnswer& answer) {
  if (!answer.is_complete || answer.status < 400) return false;
  for (const char* reason : {"BAD_FRAME", "TOO_MANY_BYTES", "TOO_BUSY"}) {
    if (answer.body.find(reason) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

bool LeaveLinesUnfinished(const Target& target) {
  constexpr int kClients = 40, kPartsOfALine = 32;
  constexpr std::size_t kPart_bytes = std::size_t{1} << 20;
  const auto end = std::chrono::steady_clock::now() + kHeld;
  const std::string chunk = "100000\r\n" + std::string(kPart_bytes, 'x') + "\r\n";
  AtOnce(kClients, [&](int i) {
    http::HttpClient client(target.http_port);
    // An object ends with its brace, all else with its line.
    const std::string start = i % 2 == 0 ? R"({"map":")" : "[\"map\",\"";
    bool goes_on = client.SendRaw("POST " + FramesPath(target) +
                                  " HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/x-ndjson\r\n"
                                  "Transfer-Encoding: chunked\r\n\r\n8\r\n" +
                                  start + "\r\n");
    for (int part = 0; part < kPartsOfALine && goes_on && std::chrono::steady_clock::now() < end; ++part) {
      goes_on = client.SendRaw(chunk);
    }
    std::this_thread::sleep_until(end);
  });
  return true;
}

bool SendLargeLines(const Target& target) {
  constexpr int kClients = 8;
  constexpr std::size_t kLine_bytes = 30'000'000;
  std::atomic<int> num_wrong = 0;
  AtOnce(kClients, [&](int i) {
    http::HttpClient client(target.http_port);
    const http::HttpAnswer answer =
        client.Ask("POST", FramesPath(target), LargeLine("line-" + std::to_string(i), kLine_bytes),
                   {{"Content-Type", "application/x-ndjson"}});
    if (IsTypedRefusal(answer)) return;
    ++num_wrong;
    std::printf("        answered with %d: %s\n", answer.status, answer.body.substr(0, 200).c_str());
  });
  return Expect("lines not refused with a reason", num_wrong, 0, "");
}

bool LeaveMessagesUnfinished(const Target& target) {
  constexpr int kConnections = 64;
  constexpr std::uint32_t kMessage_bytes = 60u << 20;
  constexpr std::size_t kSent_bytes = std::size_t{1} << 20;
  const auto end = std::chrono::steady_clock::now() + kHeld;
  const int port = std::stoi(target.grpc_address.substr(target.grpc_address.rfind(':') + 1));
  std::atomic<int> num_taken = 0;
  AtOnce(kConnections, [&](int) {
    RawGrpcCall call(port, "/dhpmap.v1.MappingService/IntegrateFrames");
    if (call.BeginMessage(kMessage_bytes) && call.Send(kSent_bytes)) ++num_taken;
    std::this_thread::sleep_until(end);
  });
  std::printf("        of %d messages the server took what came\n", num_taken.load());
  return true;
}

}  // namespace dhpmap::rig
