// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/attacks/over_maps.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <string>

namespace dhpmap::rig {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenLooks{100}, kToGiveBack{500};

/// The most that maps took lately.
class MapsLately {
 public:
  double Add(Clock::time_point now, double maps_mib) {
    looks_.push_back({now, maps_mib});
    while (looks_.front().at < now - kToGiveBack) looks_.pop_front();
    const auto less = [](const Look& a, const Look& b) { return a.maps_mib < b.maps_mib; };
    return std::max_element(looks_.begin(), looks_.end(), less)->maps_mib;
  }

 private:
  struct Look {
    Clock::time_point at;
    double maps_mib;
  };
  std::deque<Look> looks_;
};
constexpr double kBudget_mib = 256, kBeside_mib = 200;

}  // namespace

OverMapsWatch::OverMapsWatch(ServerUnderTest& server)
    : thread_([this, &server](const std::stop_token& stop) {
        MapsLately lately;
        while (!stop.stop_requested()) {
          const double resident_mib = ResidentMib(server.pid());
          const double maps_mib = server.MapsMib();
          if (maps_mib > 0) Note({resident_mib, lately.Add(Clock::now(), maps_mib)});  // else it refuses who asks
          std::this_thread::sleep_for(kBetweenLooks);
        }
      }) {}

void OverMapsWatch::Note(const Look& look) {
  const MutexLock lock(mutex_);
  if (look.over_mib() > most_.over_mib()) most_ = look;
}

OverMapsWatch::Look OverMapsWatch::most() const {
  const MutexLock lock(mutex_);
  return most_;
}

void OverMapsWatch::Reset() {
  const MutexLock lock(mutex_);
  most_ = {};
}

bool ExpectBesideMaps(const OverMapsWatch::Look& look) {
  return Expect("resident memory beside the maps, when " + std::to_string(static_cast<int>(look.resident_mib)) +
                    " MiB, of them " + std::to_string(static_cast<int>(look.maps_mib)) + " of maps, were resident",
                look.over_mib(), kBudget_mib + kBeside_mib, "MiB");
}

}  // namespace dhpmap::rig
