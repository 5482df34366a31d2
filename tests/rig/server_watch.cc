// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/server_watch.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {
namespace {

constexpr std::chrono::milliseconds kLook{50};

/// gRPC's own, which come with load and not with maps.
bool IsOfGrpc(const std::string& thread) {
  constexpr const char* kNames[] = {"default-exec",   "resolver-exec", "event_engine",
                                    "nexting_thread", "timer_manager", "grpc"};
  return std::any_of(std::begin(kNames), std::end(kNames), [&](const char* name) { return thread.starts_with(name); });
}

int NumThreadsOfGrpc(const std::filesystem::path& proc) {
  int num = 0;
  std::error_code error;
  for (auto task = std::filesystem::directory_iterator(proc / "task", error);
       !error && task != std::filesystem::directory_iterator(); task.increment(error)) {
    std::ifstream in(task->path() / "comm");
    std::string name;
    std::getline(in, name);
    num += IsOfGrpc(name);
  }
  return num;
}

}  // namespace

ProcessUse UseOf(pid_t pid) {
  const std::filesystem::path proc = "/proc/" + std::to_string(pid);
  ProcessUse use;
  std::ifstream status(proc / "status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream words(line);
    std::string key;
    double value = 0;
    words >> key >> value;
    if (key == "VmRSS:") use.resident_mib = value / 1024;
    if (key == "RssAnon:") use.anonymous_mib = value / 1024;
    if (key == "Threads:") use.num_threads = static_cast<int>(value);
  }
  use.num_threads -= NumThreadsOfGrpc(proc);
  std::error_code error;
  for (auto file = std::filesystem::directory_iterator(proc / "fd", error);
       !error && file != std::filesystem::directory_iterator(); file.increment(error)) {
    ++use.num_files;
  }
  return use;
}

double ResidentMib(pid_t pid) {
  std::ifstream statm("/proc/" + std::to_string(pid) + "/statm");
  double all_pages = 0, resident_pages = 0;
  statm >> all_pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

std::string MetricsOf(int http_port) {
  http::HttpAnswer page = http::HttpClient(http_port).Ask("GET", "/metrics");
  return page.status == 200 ? std::move(page.body) : std::string();
}

double Metric(const std::string& metrics, const std::string& name) {
  std::istringstream lines(metrics);
  double sum = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(name)) continue;
    const char next = line.size() > name.size() ? line[name.size()] : '\0';
    if (next == ' ' || next == '{') sum += std::stod(line.substr(line.rfind(' ') + 1));
  }
  return sum;
}

PeakWatch::PeakWatch(pid_t pid)
    : thread_([this, pid](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          const ProcessUse now = UseOf(pid);
          {
            const MutexLock lock(mutex_);
            peak_.resident_mib = std::max(peak_.resident_mib, now.resident_mib);
            peak_.anonymous_mib = std::max(peak_.anonymous_mib, now.anonymous_mib);
            peak_.num_threads = std::max(peak_.num_threads, now.num_threads);
            peak_.num_files = std::max(peak_.num_files, now.num_files);
          }
          std::this_thread::sleep_for(kLook);
        }
      }) {}

ProcessUse PeakWatch::peak() const {
  const MutexLock lock(mutex_);
  return peak_;
}

void PeakWatch::Reset() {
  const MutexLock lock(mutex_);
  peak_ = {};
}

}  // namespace dhpmap::rig
