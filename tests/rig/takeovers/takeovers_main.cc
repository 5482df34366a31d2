// SPDX-License-Identifier: BSD-3-Clause
// dhpmap-rig-takeovers: several servers on one PostgreSQL database. One after the other is killed, stopped or ended
// while robots feed and edit. Checks that nothing acknowledged is lost or doubled, and says how long robots waited.
#include <signal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "tests/e2e/server_process.h"
#include "tests/rig/takeovers/paced_robot.h"
#include "tests/rig/takeovers/stored_maps.h"
#include "tests/support/postgres_cluster.h"

namespace dhpmap::rig {
namespace {

struct Options {
  int servers = 4, robots = 32, faults = 50;
  double period_s = 1, timeout_s = 1;
  std::vector<std::string> kinds = {"kill", "stop", "end"};
};

enum class Fault { kKill, kStop, kEnd };
constexpr std::array<const char*, 3> kFaultNames = {"killed", "stopped", "ended"};
constexpr double kPatience_s = 20;                         ///< for the first acknowledgement after a fault
constexpr auto kUnderWay = std::chrono::milliseconds(50);  ///< what arrives so soon was sent before the fault

double At(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
}

class Takeovers {
 public:
  explicit Takeovers(const Options& options)
      : options_(options), doors_(static_cast<std::size_t>(options.servers)), corridor_(2) {}

  int Run() {
    for (std::size_t i = 0; i < doors_.size(); ++i) {
      servers_.emplace_back();
      if (!Start(i)) return 1;
    }
    if (!CreateMaps()) return 1;
    std::vector<std::thread> threads;
    for (const auto& robot : robots_) {
      threads.emplace_back([&] { robot->Run(options_.period_s, options_.timeout_s, is_over_); });
    }
    WaitUntilAllAreHeard(PacedRobot::Clock::now());
    std::mt19937 random(1);
    for (int n = 0; n < options_.faults; ++n) {
      const std::string& kind = options_.kinds[static_cast<std::size_t>(n) % options_.kinds.size()];
      const Fault fault = kind == "kill" ? Fault::kKill : kind == "stop" ? Fault::kStop : Fault::kEnd;
      if (!Do(fault, BusyServer(random))) break;
    }
    is_over_ = true;
    for (std::thread& thread : threads) thread.join();
    Check();
    Tell();
    return complaints_.empty() ? 0 : 1;
  }

 private:
  bool Start(std::size_t i) {
    servers_[i] = std::make_unique<testing::ServerProcess>(logs_.path(), testing::PostgresCluster::Get()->Url());
    if (servers_[i]->is_serving()) doors_.Set(i, servers_[i]->grpc_address());
    else complaints_.push_back("a server does not start: " + servers_[i]->process().Stderr());
    return servers_[i]->is_serving();
  }

  bool CreateMaps() {
    for (int i = 0; i < options_.robots; ++i) {
      const std::size_t server = static_cast<std::size_t>(i) % doors_.size();
      const std::string id = "m" + std::to_string(i);
      const auto maps = v1::MapService::NewStub(doors_.ChannelTo(server));
      grpc::ClientContext context;
      v1::CreateMapResponse response;
      const grpc::Status created = maps->CreateMap(&context, CorridorMap(id, id), &response);
      if (!created.ok()) {
        complaints_.push_back("no map: " + created.error_message());
        return false;
      }
      const std::size_t step =
          1 + static_cast<std::size_t>(i) / doors_.size() % std::max<std::size_t>(doors_.size() - 1, 1);
      robots_.push_back(std::make_unique<PacedRobot>(doors_, corridor_, "maps/" + id, server, step));
    }
    return true;
  }

  /// Of those that own maps, one at random.
  std::size_t BusyServer(std::mt19937& random) const {
    const auto& robot = robots_[std::uniform_int_distribution<std::size_t>(0, robots_.size() - 1)(random)];
    return robot->acknowledged().back().server;
  }

  /// Makes a fault of one server, waits until its robots are served again, and brings the server back.
  bool Do(Fault fault, std::size_t victim) {
    std::vector<PacedRobot*> hit;
    for (const auto& robot : robots_) {
      if (robot->acknowledged().back().server == victim) hit.push_back(robot.get());
    }
    const auto begin = PacedRobot::Clock::now();
    testing::Process& process = servers_[victim]->process();
    process.Signal(fault == Fault::kKill ? SIGKILL : fault == Fault::kStop ? SIGSTOP : SIGTERM);
    for (const PacedRobot* robot : hit) NoteWait(*robot, fault, begin);
    if (fault == Fault::kStop) {
      process.Signal(SIGCONT);
    } else {
      const auto code = process.Wait(30);
      if (fault == Fault::kEnd && code != 0) complaints_.push_back("a server does not end well: " + process.Stderr());
      if (!Start(victim)) return false;
    }
    WaitUntilAllAreHeard(PacedRobot::Clock::now());
    std::printf("%s server %zu, of %zu robots\n", kFaultNames[static_cast<std::size_t>(fault)], victim, hit.size());
    std::fflush(stdout);
    return true;
  }

  /// The first acknowledgement that a robot gets after `begin`; nothing if none comes.
  static std::optional<PacedRobot::Clock::time_point> HeardAfter(const PacedRobot& robot,
                                                                 PacedRobot::Clock::time_point begin) {
    const auto end = PacedRobot::Clock::now() + std::chrono::duration<double>(kPatience_s);
    while (PacedRobot::Clock::now() < end) {
      const auto acknowledged = robot.acknowledged();
      if (!acknowledged.empty() && acknowledged.back().time >= begin) {
        return std::find_if(acknowledged.begin(), acknowledged.end(),
                            [&](const auto& its) { return its.time >= begin; })
            ->time;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return {};
  }

  void WaitUntilAllAreHeard(PacedRobot::Clock::time_point since) {
    for (const auto& robot : robots_) {
      if (!HeardAfter(*robot, since + kUnderWay)) complaints_.push_back(robot->map() + " waits still");
    }
  }

  void NoteWait(const PacedRobot& robot, Fault fault, PacedRobot::Clock::time_point begin) {
    const auto heard = HeardAfter(robot, begin + kUnderWay);
    const double wait_s = heard ? std::chrono::duration<double>(*heard - begin).count() : 99;
    waits_[static_cast<std::size_t>(fault)].push_back(wait_s);
    if (!heard) complaints_.push_back(robot.map() + " waits still");
  }

  void Check() {
    for (const auto& robot : robots_) {
      const auto acknowledged = robot->acknowledged();
      const std::int64_t last = acknowledged.empty() ? 0 : acknowledged.back().sequence;
      num_acknowledged_ += last;
      num_edits_ += static_cast<std::int64_t>(robot->edit_revisions().size());
      const auto add = [this](const std::vector<std::string>& more) {
        complaints_.insert(complaints_.end(), more.begin(), more.end());
      };
      add(ComplaintsOfStored(doors_.ChannelTo(0), robot->map(), last, robot->edit_revisions()));
      add(robot->complaints());
    }
  }

  void Tell() {
    int num_sent_on = 0, num_failed = 0;
    for (const auto& robot : robots_) {
      num_sent_on += robot->num_sent_on();
      num_failed += robot->num_failed();
    }
    std::printf("%lld frames and %lld edits acknowledged, sent on %d times, failed calls %d\n",
                static_cast<long long>(num_acknowledged_), static_cast<long long>(num_edits_), num_sent_on, num_failed);
    for (std::size_t i = 0; i < kFaultNames.size(); ++i) {
      std::printf("%s: %zu waits, p50 %.2f s, p99 %.2f s, longest %.2f s\n", kFaultNames[i], waits_[i].size(),
                  At(waits_[i], 0.5), At(waits_[i], 0.99), At(waits_[i], 1));
    }
    std::printf("%zu complaints\n", complaints_.size());
    for (const std::string& complaint : complaints_) std::printf("  %s\n", complaint.c_str());
  }

  const Options options_;
  testing::TempDir logs_;
  Doors doors_;
  const Corridor corridor_;
  std::vector<std::unique_ptr<testing::ServerProcess>> servers_;
  std::vector<std::unique_ptr<PacedRobot>> robots_;
  std::atomic<bool> is_over_ = false;
  std::array<std::vector<double>, 3> waits_;
  std::int64_t num_acknowledged_ = 0, num_edits_ = 0;
  std::vector<std::string> complaints_;
};

}  // namespace
}  // namespace dhpmap::rig

int main(int argc, char** argv) {
  dhpmap::rig::Options options;
  CLI::App app{"Kills, stops and ends servers on one database while robots feed and edit, and checks what is stored"};
  app.add_option("--servers", options.servers, "Processes")->capture_default_str();
  app.add_option("--robots", options.robots, "Each feeds a map of its own")->capture_default_str();
  app.add_option("--faults", options.faults, "How many, of the kinds in turn")->capture_default_str();
  app.add_option("--kinds", options.kinds, "kill (SIGKILL), stop (SIGSTOP), end (SIGTERM)")
      ->delimiter(',')
      ->check(CLI::IsMember({"kill", "stop", "end"}))
      ->capture_default_str();
  app.add_option("--period", options.period_s, "s between a robot's frames")->capture_default_str();
  app.add_option("--timeout", options.timeout_s, "s after which a robot tries another server")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (dhpmap::testing::PostgresCluster::Get() == nullptr) {
    std::puts(dhpmap::testing::PostgresCluster::WhyThereIsNone());
    return 2;
  }
  return dhpmap::rig::Takeovers(options).Run();
}
