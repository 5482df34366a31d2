// SPDX-License-Identifier: BSD-3-Clause
#include "server/metrics/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/histogram.h>
#include <prometheus/metric_family.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <utility>

#include "mapping/base/free_memory.h"
#include "mapping/base/memory_count.h"

namespace dhpmap {
namespace {

using prometheus::Counter;
using prometheus::Family;
using prometheus::Histogram;

Histogram::BucketBoundaries SecondsBuckets() {
  return {0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30};
}

std::string Name(StatusCode code) { return std::string(StatusCodeName(code)); }

template <typename Number>
prometheus::MetricFamily GaugeFamily(const std::string& name, const std::string& help,
                                     const std::vector<Metrics::MapGauges>& maps, Number Metrics::MapGauges::*field) {
  prometheus::MetricFamily family;
  family.name = name;
  family.help = help;
  family.type = prometheus::MetricType::Gauge;
  for (const Metrics::MapGauges& map : maps) {
    prometheus::ClientMetric metric;
    metric.label = {{"map", map.name}};
    metric.gauge.value = static_cast<double>(map.*field);
    family.metric.push_back(std::move(metric));
  }
  return family;
}

/// Names and types as in the client libraries of Prometheus.
prometheus::MetricFamily Gauge(const std::string& name, const std::string& help, double value) {
  prometheus::MetricFamily family;
  family.name = name;
  family.help = help;
  family.type = prometheus::MetricType::Gauge;
  family.metric.emplace_back();
  family.metric.back().gauge.value = value;
  return family;
}

prometheus::MetricFamily CounterOf(const std::string& name, const std::string& help, double value) {
  prometheus::MetricFamily family;
  family.name = name;
  family.help = help;
  family.type = prometheus::MetricType::Counter;
  family.metric.emplace_back();
  family.metric.back().counter.value = value;
  return family;
}
prometheus::MetricFamily CounterOf(const std::string& name, const std::string& help, std::uint64_t value) {
  return CounterOf(name, help, static_cast<double>(value));
}

using ValueOfKind = std::pair<const char*, std::size_t>;

prometheus::MetricFamily GaugeByKind(const std::string& name, const std::string& help,
                                     const std::vector<ValueOfKind>& values) {
  prometheus::MetricFamily family;
  family.name = name;
  family.help = help;
  family.type = prometheus::MetricType::Gauge;
  for (const auto& [kind, value] : values) {
    prometheus::ClientMetric metric;
    metric.label = {{"kind", kind}};
    metric.gauge.value = static_cast<double>(value);
    family.metric.push_back(std::move(metric));
  }
  return family;
}

constexpr std::pair<const char*, MemoryKind> kScratchKinds[] = {
    {"refinement", MemoryKind::kRefinement}, {"meshing", MemoryKind::kMeshing}, {"fusion", MemoryKind::kFusion}};

std::vector<ValueOfKind> ScratchByKind(std::size_t (MemoryCount::*value)() const noexcept) {
  std::vector<ValueOfKind> values;
  for (const auto& [name, kind] : kScratchKinds) values.emplace_back(name, (CountOf(kind).*value)());
  return values;
}

std::size_t MapsBytes(const std::vector<Metrics::MapGauges>& maps) {
  std::int64_t bytes = static_cast<std::int64_t>(CountOf(MemoryKind::kBlocks).now_bytes());
  for (const Metrics::MapGauges& map : maps) bytes += std::max<std::int64_t>(0, map.memory_bytes - map.block_bytes);
  return static_cast<std::size_t>(bytes);
}

/// `a` - `b`, at least 0: both change between the two reads.
std::size_t Rest(std::size_t a, std::size_t b) { return a > b ? a - b : 0; }

/// Counts each byte once.
std::vector<ValueOfKind> MemoryByKind(const Metrics::Gauges& gauges, const std::optional<HeapUse>& heap) {
  std::vector<ValueOfKind> values = ScratchByKind(&MemoryCount::now_bytes);
  values.emplace_back("maps", MapsBytes(gauges.maps));
  values.emplace_back("surfaces", gauges.surface_bytes + CountOf(MemoryKind::kTileRooms).now_bytes());
  values.emplace_back("requests",
                      Rest(gauges.inflight_bytes, CountOf(MemoryKind::kReserved).now_bytes()) + gauges.frame_bytes);
  values.emplace_back("store", static_cast<std::size_t>(std::max<std::int64_t>(0, gauges.store_bytes)));
  values.emplace_back("allocator", heap ? Rest(heap->resident_bytes, heap->live_bytes) : 0);
  return values;
}

void AddFleet(const Metrics::FleetGauges& fleet, std::vector<prometheus::MetricFamily>& families) {
  const auto gauge = [&](const char* name, const char* help, auto value) {
    families.push_back(Gauge(name, help, static_cast<double>(value)));
  };
  const auto counter = [&](const char* name, const char* help, std::int64_t value) {
    families.push_back(CounterOf(name, help, static_cast<double>(value)));
  };
  gauge("dhpmap_fleet_maps", "Maps that this server owns", fleet.num_owned);
  counter("dhpmap_fleet_takeovers_total", "Maps taken over from servers that had died", fleet.num_taken_over);
  counter("dhpmap_fleet_lost_maps_total", "Maps that another server has taken over from this one", fleet.num_lost);
  counter("dhpmap_fleet_failed_beats_total", "Beats that the database did not take", fleet.num_failed_beats);
  gauge("dhpmap_fleet_copies", "Copies of maps that other servers own", fleet.num_copies);
  gauge("dhpmap_fleet_copy_memory_bytes", "Memory of these copies", fleet.copy_bytes);
  gauge("dhpmap_fleet_copies_behind_seconds", "For how long a copy has lacked a commit that the server knows of",
        fleet.copies_behind_s);
  gauge("dhpmap_fleet_schema", "Schema of the database", fleet.schema);
}

/// A value of /proc/self/status, such as "RssAnon" in kB; 0 if it is missing.
double ProcessStatus(const std::string& key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(key + ":")) return std::strtod(line.c_str() + key.size() + 1, nullptr);
  }
  return 0;
}

}  // namespace

struct Metrics::Impl {
  prometheus::Registry registry;
  Family<Histogram>& calls =
      prometheus::BuildHistogram().Name("dhpmap_rpc_seconds").Help("Time from request to answer").Register(registry);
  Family<Counter>& frames =
      prometheus::BuildCounter().Name("dhpmap_ingest_frames_total").Help("Frames taken or refused").Register(registry);
  Counter& query_points = prometheus::BuildCounter()
                              .Name("dhpmap_query_points_total")
                              .Help("Points answered by QueryPoints")
                              .Register(registry)
                              .Add({});
  Family<Counter>& relayed = prometheus::BuildCounter()
                                 .Name("dhpmap_relayed_calls_total")
                                 .Help("Calls that were passed on to the owner of their map, another server")
                                 .Register(registry);
  Family<Counter>& refused = prometheus::BuildCounter()
                                 .Name("dhpmap_guard_refused_total")
                                 .Help("Connections that a door has refused or ended for what they did")
                                 .Register(registry);
  Family<Histogram>& commits = prometheus::BuildHistogram()
                                   .Name("dhpmap_commit_seconds")
                                   .Help("Time of a commit to the store")
                                   .Register(registry);
  Family<Histogram>& refinements = prometheus::BuildHistogram()
                                       .Name("dhpmap_refinement_seconds")
                                       .Help("Time of a refinement that was taken over, by step")
                                       .Register(registry);
};

Metrics::Metrics() : impl_(std::make_unique<Impl>()) {}
Metrics::~Metrics() = default;

void Metrics::RecordCall(std::string_view method, StatusCode code, double seconds) {
  impl_->calls.Add({{"method", std::string(method)}, {"code", Name(code)}}, SecondsBuckets()).Observe(seconds);
}

void Metrics::RecordQuery(std::size_t num_points) { impl_->query_points.Increment(static_cast<double>(num_points)); }

void Metrics::RecordFrame(StatusCode code) { impl_->frames.Add({{"code", Name(code)}}).Increment(); }

void Metrics::RecordRelayed(StatusCode code) { impl_->relayed.Add({{"code", Name(code)}}).Increment(); }

void Metrics::RecordRefused(std::string_view door, std::string_view why) {
  impl_->refused.Add({{"door", std::string(door)}, {"why", std::string(why)}}).Increment();
}

void Metrics::RecordCommit(StatusCode code, double seconds) {
  impl_->commits.Add({{"code", Name(code)}}, SecondsBuckets()).Observe(seconds);
}

void Metrics::RecordRefinement(double management_s, double crf_s) {
  impl_->refinements.Add({{"step", "management"}}, SecondsBuckets()).Observe(management_s);
  impl_->refinements.Add({{"step", "crf"}}, SecondsBuckets()).Observe(crf_s);
}

std::string Metrics::Text(const Gauges& gauges) const {
  auto families = impl_->registry.Collect();
  families.push_back(GaugeFamily("dhpmap_map_submaps", "Submaps of an open map", gauges.maps, &MapGauges::num_submaps));
  families.push_back(GaugeFamily("dhpmap_map_blocks", "Blocks of an open map", gauges.maps, &MapGauges::num_blocks));
  families.push_back(
      GaugeFamily("dhpmap_map_revision", "Published revision of an open map", gauges.maps, &MapGauges::revision));
  families.push_back(
      GaugeFamily("dhpmap_map_memory_bytes", "Memory that an open map takes", gauges.maps, &MapGauges::memory_bytes));
  families.push_back(
      GaugeFamily("dhpmap_map_feeds", "Streams that feed an open map", gauges.maps, &MapGauges::num_feeds));
  families.push_back(GaugeFamily("dhpmap_store_behind_seconds", "For how long what was fused has not been stored",
                                 gauges.maps, &MapGauges::behind_s));
  families.push_back(Gauge("dhpmap_surface_memory_bytes", "Memory of surfaces and distance fields made for queries",
                           static_cast<double>(gauges.surface_bytes)));
  families.push_back(Gauge("dhpmap_past_states_memory_bytes",
                           "Memory of states kept to be read again, as far as later ones do not share it",
                           static_cast<double>(gauges.past_bytes)));
  families.push_back(CounterOf("dhpmap_audit_dropped_total", "Rows that the audit log in the database lacks",
                               static_cast<double>(gauges.num_audit_dropped)));
  families.push_back(Gauge("dhpmap_insecure", "1: a switch lets strangers in", gauges.is_insecure ? 1 : 0));
  families.push_back(Gauge("dhpmap_watchers", "Who watches maps", static_cast<double>(gauges.num_watchers)));
  families.push_back(Gauge("dhpmap_inflight_bytes",
                           "Memory of requests, answers and of what only states held for them still need",
                           static_cast<double>(gauges.inflight_bytes)));
  families.push_back(Gauge("dhpmap_record_bytes", "Size of the records of frames that are kept",
                           static_cast<double>(gauges.record_bytes)));
  families.push_back(Gauge("dhpmap_page_memory_bytes",
                           "Memory of voxels that were read from the store when they were needed",
                           static_cast<double>(gauges.page_bytes)));
  families.push_back(
      CounterOf("dhpmap_pages_read_total", "Tiles of voxels that were read from the disk", gauges.num_pages_read));
  families.push_back(CounterOf("dhpmap_page_hits_total",
                               "Lookups of voxels in such a tile that was in memory already, about",
                               gauges.num_page_hits));
  families.push_back(CounterOf("dhpmap_pages_read_seconds_total", "Time that reading them took, of all threads",
                               static_cast<double>(gauges.page_read_ns) * 1e-9));
  families.push_back(Gauge("dhpmap_page_held_bytes", "Memory of such voxels that requests under way have read",
                           static_cast<double>(gauges.page_held_bytes)));
  families.push_back(CounterOf("dhpmap_pages_unreadable_total", "Tries to read a tile of voxels that failed",
                               gauges.num_pages_unreadable));
  families.push_back(CounterOf("dhpmap_pages_let_go_total",
                               "Tiles of voxels that were left on the disk again, as there were too many in memory",
                               gauges.num_pages_evicted));
  families.push_back(CounterOf("dhpmap_pages_spilled_total",
                               "Tiles of voxels that frames wrote and that were left in a file beside the database",
                               gauges.num_spilled));
  families.push_back(
      CounterOf("dhpmap_pages_unspilled_total", "Tries to leave one there that failed", gauges.num_unspilled));
  families.push_back(Gauge("dhpmap_spill_bytes", "Size of that file", static_cast<double>(gauges.spill_bytes)));
  if (gauges.fleet) AddFleet(*gauges.fleet, families);
  constexpr double kKiB = 1024;
  families.push_back(
      Gauge("process_resident_memory_bytes", "Memory of the process that is in RAM", kKiB * ProcessStatus("VmRSS")));
  families.push_back(Gauge("dhpmap_anonymous_memory_bytes", "Of it, what is not of files: maps and all else",
                           kKiB * ProcessStatus("RssAnon")));
  families.push_back(GaugeByKind("dhpmap_scratch_bytes", "Working memory that is allocated now",
                                 ScratchByKind(&MemoryCount::now_bytes)));
  families.push_back(GaugeByKind("dhpmap_scratch_peak_bytes", "Working memory that was allocated at most",
                                 ScratchByKind(&MemoryCount::most_bytes)));
  const auto heap = HeapUseNow();
  families.push_back(GaugeByKind("dhpmap_memory_bytes", "Memory that the server has counted itself, each byte once",
                                 MemoryByKind(gauges, heap)));
  if (heap) {
    families.push_back(Gauge("dhpmap_heap_live_bytes", "Memory that the server has allocated and not freed",
                             static_cast<double>(heap->live_bytes)));
    families.push_back(Gauge("dhpmap_heap_resident_bytes", "Memory of the allocator that is in RAM, gaps included",
                             static_cast<double>(heap->resident_bytes)));
  }
  families.push_back(Gauge("process_threads", "Threads of the process", ProcessStatus("Threads")));
  return prometheus::TextSerializer().Serialize(families);
}

}  // namespace dhpmap
