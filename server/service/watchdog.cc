// SPDX-License-Identifier: BSD-3-Clause
#include "server/service/watchdog.h"

#include <charconv>
#include <thread>
#include <utility>

#include "mapping/base/mutex.h"
#include "mapping/base/this_thread.h"
#include "server/service/notifier.h"

namespace dhpmap::service {
namespace {

std::optional<long long> NumberIn(const std::string& text) {
  long long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<std::chrono::microseconds> WatchdogTime(const std::vector<std::string>& environment, int pid) {
  constexpr long long kLongest_us = 1'000'000'000'000;  // 11 days
  const std::string whose = ValueIn(environment, "WATCHDOG_PID");
  if (!whose.empty() && NumberIn(whose) != pid) return std::nullopt;
  const auto time_us = NumberIn(ValueIn(environment, "WATCHDOG_USEC"));
  if (!time_us || *time_us <= 0 || *time_us > kLongest_us) return std::nullopt;
  return std::chrono::microseconds(*time_us);
}

struct Watchdog::Impl {
  Impl(std::chrono::microseconds every, LanePulse beating) : period(every), pulse(std::move(beating)) {}

  void Run() DHPMAP_EXCLUDES(mutex) {
    NameThisThread("watchdog");
    const MutexLock lock(mutex);
    do {
      pulse.Beat();
    } while (!stopped.WaitFor(mutex, period, [this]() DHPMAP_REQUIRES(mutex) { return is_stopping; }));
  }

  const std::chrono::microseconds period;
  LanePulse pulse;
  Mutex mutex;
  CondVar stopped;
  bool is_stopping DHPMAP_GUARDED_BY(mutex) = false;
  std::thread thread;
};

Watchdog::Watchdog(std::chrono::microseconds time, LanePulse pulse)
    : impl_(std::make_unique<Impl>(time / 3, std::move(pulse))) {
  impl_->thread = std::thread([impl = impl_.get()] { impl->Run(); });
}

Watchdog::~Watchdog() {
  {
    const MutexLock lock(impl_->mutex);
    impl_->is_stopping = true;
    impl_->stopped.NotifyAll();
  }
  impl_->thread.join();
}

}  // namespace dhpmap::service
