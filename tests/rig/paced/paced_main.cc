// SPDX-License-Identifier: BSD-3-Clause
// dhpmap-rig-paced: robots that feed running servers at an even pace. Says when its window of measurement begins and
// ends, so that a script can look at the servers then: tests/rig/fleet/table.py.
#include <grpcpp/grpcpp.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "tests/rig/clients/lone_channel.h"
#include "tests/rig/paced/feeding_robot.h"

namespace dhpmap::rig {
namespace {

struct Options {
  std::vector<std::string> servers;
  int robots = 8;
  double rate_hz = 2, warm_up_s = 4, window_s = 15;
  std::string prefix = "paced";
};

void Sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// Each with a map of its own, shared out evenly among the servers, which own the maps that they create.
std::vector<std::unique_ptr<FeedingRobot>> MakeRobots(const Options& options, const Corridor& corridor) {
  std::vector<std::unique_ptr<FeedingRobot>> robots;
  for (int i = 0; i < options.robots; ++i) {
    const auto channel = LoneChannel(options.servers[static_cast<std::size_t>(i) % options.servers.size()]);
    const std::string id = options.prefix + "-" + std::to_string(i);
    grpc::ClientContext context;
    v1::CreateMapResponse response;
    const auto created = v1::MapService::NewStub(channel)->CreateMap(&context, CorridorMap(id, id), &response);
    if (!created.ok()) {
      std::printf("no map: %s\n", created.error_message().c_str());
      break;
    }
    robots.push_back(std::make_unique<FeedingRobot>(channel, corridor, "maps/" + id));
  }
  return robots;
}

std::int64_t NumFused(const std::vector<std::unique_ptr<FeedingRobot>>& robots) {
  std::int64_t sum = 0;
  for (const auto& robot : robots) sum += robot->num_fused();
  return sum;
}

void Say(const char* what, std::int64_t num_fused) {
  std::printf("%s %lld\n", what, static_cast<long long>(num_fused));
  std::fflush(stdout);
}

int Run(const Options& options) {
  const Corridor corridor(2);
  const auto robots = MakeRobots(options, corridor);
  if (static_cast<int>(robots.size()) < options.robots) return 1;
  const double period_s = 1 / options.rate_hz;
  std::atomic<bool> is_over = false;
  std::vector<std::thread> threads;
  auto first = std::chrono::steady_clock::now();
  for (const auto& robot : robots) {
    first += std::chrono::microseconds(static_cast<std::int64_t>(1e6 * period_s / options.robots));
    threads.emplace_back([&, &feeding = *robot, begin = first] { feeding.Run(begin, period_s, is_over); });
  }
  Sleep(options.warm_up_s);
  Say("begin", NumFused(robots));
  Sleep(options.window_s);
  Say("end", NumFused(robots));
  is_over = true;
  for (std::thread& thread : threads) thread.join();
  std::int64_t num_sent = 0;
  int num_complaints = 0;
  for (const auto& robot : robots) {
    num_sent += robot->num_sent();
    num_complaints += robot->complaint().empty() ? 0 : 1;
    if (!robot->complaint().empty()) std::printf("%s\n", robot->complaint().c_str());
  }
  Say("stored", num_complaints == 0 ? num_sent : -1);
  return num_complaints == 0 ? 0 : 1;
}

}  // namespace
}  // namespace dhpmap::rig

int main(int argc, char** argv) {
  dhpmap::rig::Options options;
  CLI::App app{"Robots that feed running servers at an even pace"};
  app.add_option("--servers", options.servers, "Addresses of their gRPC")->required()->delimiter(',');
  app.add_option("--robots", options.robots, "Each feeds a map of its own")->capture_default_str();
  app.add_option("--rate", options.rate_hz, "Frames/s of a robot")->capture_default_str();
  app.add_option("--warm-up", options.warm_up_s, "s before the window")->capture_default_str();
  app.add_option("--window", options.window_s, "s of measurement")->capture_default_str();
  app.add_option("--prefix", options.prefix, "Names of the maps begin so")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return dhpmap::rig::Run(options);
}
