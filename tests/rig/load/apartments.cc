// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "tests/rig/load/counted_memory.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"
#include "tests/support/client.h"

namespace dhpmap::rig {
namespace {

constexpr double kMostAfter_mib = 250, kMostOverMap_mib = 300, kMostUnexplained_percent = 20;

/// The shares of a server's memory that its own count does not explain, %, at worst.
struct Unexplained {
  double with_map = 0, finishing = 0, after_answers = 0;
  double mapping = 0;  ///< only told: while a map is small, a few frames are much beside it
};

void Raise(double& most, double value) { most = std::max(most, value); }

bool Judge(const Unexplained& most) {
  std::printf("not explained while mapping, in nine of ten looks: %.1f %%\n", most.mapping);
  bool held =
      Expect("not explained by what the server counts: finishing", most.finishing, kMostUnexplained_percent, "%");
  held &= Expect("likewise, once a map is finished", most.with_map, kMostUnexplained_percent, "%");
  held &= Expect("likewise, once it was queried and meshed", most.after_answers, kMostUnexplained_percent, "%");
  return held;
}

}  // namespace

bool RunApartments(const ApartmentsOptions& options) {
  ServerUnderTest server;
  const testing::Client client(server.process().Connect());
  const CountedMemory memory(server);
  PeakWatch watch(server.pid());
  bool held = true;
  double most_over_map_mib = 0;
  Unexplained most;
  for (int i = 0; i < options.repetitions; ++i) {
    const std::string map_id = "apartment" + std::to_string(i);
    const double before_mib = UseOf(server.pid()).anonymous_mib;
    watch.Reset();
    {
      MemoryLooks looks(memory);
      if (!server.MapDataset(options.dataset, map_id, {"--no-finish"})) return false;
      Raise(most.mapping, UnexplainedInMost_percent(looks.End()));
    }
    const double mapping_mib = watch.peak().anonymous_mib;
    watch.Reset();
    {
      MemoryLooks looks(memory);
      if (!client.Call(&testing::MappingStub::FinishMapping, "maps/" + map_id).ok()) return false;
      Raise(most.finishing, UnexplainedInMost_percent(looks.End()));
    }
    const double map_mib = server.Metric("dhpmap_map_memory_bytes") / (1 << 20);
    Raise(most_over_map_mib, watch.peak().anonymous_mib - before_mib - map_mib);
    Raise(most.with_map, memory.Look().unexplained_percent());
    BulkCalls calls(server.TargetOf(map_id));
    const bool answered = calls.ManyPoints(500'000) &&
                          client.Call(&testing::SubmapStub::CloneSubmap, "maps/" + map_id + "/submaps/1").ok() &&
                          calls.WholeMesh();
    const MemoryLook look = memory.Look();
    Raise(most.after_answers, look.unexplained_percent());
    if (i % 5 == 0) memory.Tell();
    if (!answered || !client.Call(&testing::MapStub::DeleteMap, "maps/" + map_id).ok()) {
      std::printf("FAILED: a call on %s\n", map_id.c_str());
      held = false;
    }
    if (i % 5 == 0) {
      std::printf("%d: map %.0f MiB, mapping at most %.0f, then %.0f, counted %.0f of %.0f, deleted %.0f\n", i, map_mib,
                  mapping_mib, watch.peak().anonymous_mib, look.counted_mib, look.anonymous_mib,
                  UseOf(server.pid()).anonymous_mib);
      std::fflush(stdout);
    }
  }
  std::this_thread::sleep_for(std::chrono::seconds(15));
  held &= Expect("anonymous memory at the end", UseOf(server.pid()).anonymous_mib, kMostAfter_mib, "MiB");
  held &= Expect("FinishMapping, over the map", most_over_map_mib, kMostOverMap_mib, "MiB");
  const double scratch_mib = server.Metric("dhpmap_scratch_peak_bytes{kind=\"refinement\"}") / (1 << 20);
  held &= Expect("refinements whose scratch nobody counted", scratch_mib == 0 ? options.repetitions : 0, 0, "");
  held &= Expect("scratch of refinement, at most", scratch_mib, kMostOverMap_mib, "MiB");
  held &= Expect("scratch at the end", server.Metric("dhpmap_scratch_bytes") / (1 << 20), 0, "MiB");
  held &= Judge(most);
  return held;
}

}  // namespace dhpmap::rig
