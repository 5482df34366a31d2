// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <future>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/map/history_id.h"
#include "mapping/pipeline/map_builder.h"
#include "server/base/lane.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "tests/bench/bench.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/frames.h"

namespace dhpmap::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kMega = 1e6;
constexpr std::size_t kPart_bytes = 256u << 10;  ///< of a file, as the server's doors have them
constexpr double kBesideWalks_m = 60;            ///< each walk is mapped so far beside the one before

double Since_s(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// What took how long, of how many bytes.
struct Spent {
  double wall_s = 0, cpu_s = 0, bytes = 0;

  /// Runs `work`, whose bytes the caller adds.
  template <typename Work>
  auto Time(Work&& work) {
    const auto begin = Clock::now();
    const double cpu_s_before = ProcessCpu_s();
    auto result = work();
    wall_s += Since_s(begin);
    cpu_s += ProcessCpu_s() - cpu_s_before;
    return result;
  }
};

void PrintRow(const char* what, const Spent& spent) {
  std::printf("%-38s %9.1f %9.2f %9.2f %10.1f %10.1f\n", what, spent.bytes / kMega, spent.wall_s, spent.cpu_s,
              spent.bytes / kMega / std::max(spent.wall_s, 1e-9), spent.bytes / kMega / std::max(spent.cpu_s, 1e-9));
}

/// A folder that goes with its end.
struct Folder {
  explicit Folder(const std::string& parent)
      : path(fs::path(parent) / ("store-bench-" + std::to_string(DrawHistoryId()))) {
    fs::create_directories(path);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path path;
};

Result<MapInfo> InfoFor(const Dataset& dataset, const std::string& name, double voxel_size_m) {
  MapInfo info;
  info.name = name;
  info.history_id = DrawHistoryId();
  DHPMAP_RETURN_IF_ERROR(ApplyPreset(dataset.preset(), info.config));
  if (voxel_size_m > 0) {
    info.config.truncation_m *= voxel_size_m / info.config.voxel_size_m;
    info.config.voxel_size_m = voxel_size_m;
  }
  DHPMAP_RETURN_IF_ERROR(info.config.Validate());
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(dataset.label_classes()));
  info.label_set = std::make_shared<LabelSet>(std::move(label_set));
  return info;
}

/// A map that is fused and committed frame after frame, one walk beside the other.
class Mapping {
 public:
  Mapping(MapStore& store, MapInfo info, const std::vector<PanopticFrame>& frames, int commit_frames)
      : store_(store), frames_(frames), commit_frames_(commit_frames), builder_(std::move(info), 0) {}

  Status Begin() {
    const auto state = builder_.map().Publish(++time_ns_);
    DHPMAP_RETURN_IF_ERROR(store_.CreateMap(*state));
    stored_ = StateMarks(*state);
    return Status::Ok();
  }
  /// So many frames more, and a commit.
  Status Go() {
    for (int n = 0; n < commit_frames_; ++n) {
      PanopticFrame frame = frames_[next_ % frames_.size()];
      frame.has_persistent_ids = false;
      frame.T_map_sensor.translation().x() += kBesideWalks_m * static_cast<double>(next_ / frames_.size());
      ++next_;
      DHPMAP_RETURN_IF_ERROR(builder_.Integrate(frame).status());
    }
    return Commit();
  }
  Status Commit() {
    const auto state = builder_.map().Publish(++time_ns_);
    const Status committed = commit_.Time([&] { return store_.Commit(stored_, *state, Durability::kNormal); });
    stored_ = StateMarks(*state, &stored_);
    return committed;
  }
  Spent& commit() { return commit_; }

 private:
  MapStore& store_;
  const std::vector<PanopticFrame>& frames_;
  const int commit_frames_;
  MapBuilder builder_;
  StateMarks stored_;
  std::int64_t time_ns_ = 0;
  std::size_t next_ = 0;
  Spent commit_;
};

Result<double> StoredBytes(MapStore& store, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(const StoredMap map, store.GetMap(name));
  return static_cast<double>(map.blob_bytes);
}

Status MakeMap(MapStore& store, Mapping& mapping, const StoreBenchOptions& options) {
  DHPMAP_RETURN_IF_ERROR(mapping.Begin());
  for (double bytes = 0; bytes < options.size_mib * (1 << 20);) {
    DHPMAP_RETURN_IF_ERROR(mapping.Go());
    DHPMAP_ASSIGN_OR_RETURN(bytes, StoredBytes(store, "bench"));
    mapping.commit().bytes = bytes;
  }
  return Status::Ok();
}

/// The map as a file.
Status Export(MapStore& store, const fs::path& path, Spent& spent) {
  return spent.Time([&]() -> Status {
    DHPMAP_ASSIGN_OR_RETURN(const auto file, store.ExportMap("bench", {}));
    std::FILE* out = std::fopen(path.c_str(), "wb");
    if (out == nullptr) return Unavailable("cannot write " + path.string());
    Status status;
    for (std::string part = "x"; status.ok() && !part.empty();) {
      Result<std::string> read = file->Read(kPart_bytes);
      status = read.status();
      part = read.ok() ? std::move(*read) : "";
      if (std::fwrite(part.data(), 1, part.size(), out) != part.size()) status = ResourceExhausted("cannot write");
    }
    std::fclose(out);
    spent.bytes = static_cast<double>(file->size_bytes());
    return status;
  });
}

/// How long commits of a map that is mapped take, one every so often.
class Committer {
 public:
  Committer(Mapping& mapping, double every_s)
      : thread_([this, &mapping, every_s] {
          while (!is_over_) {
            const double before_s = mapping.commit().wall_s;
            if (Status went = mapping.Go(); !went.ok()) {
              status_ = went;
              return;
            }
            times_ms_.push_back(1e3 * (mapping.commit().wall_s - before_s));
            std::this_thread::sleep_for(std::chrono::duration<double>(every_s));
          }
        }) {}
  ~Committer() { (void)Stop(); }
  Committer(const Committer&) = delete;
  Committer& operator=(const Committer&) = delete;

  Status Stop() {
    is_over_ = true;
    if (thread_.joinable()) thread_.join();
    return status_;
  }
  void Print(const char* when) const {
    std::vector<double> sorted = times_ms_;
    std::sort(sorted.begin(), sorted.end());
    if (sorted.empty()) return;
    std::printf("%-38s %9zu %9.1f %9.1f %10.1f\n", when, sorted.size(), sorted[sorted.size() / 2],
                sorted[sorted.size() * 99 / 100], sorted.back());
  }

 private:
  std::atomic<bool> is_over_ = false;
  Status status_;
  std::vector<double> times_ms_;
  std::thread thread_;
};

/// As nice as the server's lane for bulk calls, on which maps come in but for their last step.
constexpr int kBulkNiceness = 15;

/// Runs `work` on a thread of the lane.
Status RunIn(Lane& lane, const std::function<Status()>& work) {
  std::promise<Status> done;
  lane.Post([&] { done.set_value(work()); });
  return done.get_future().get();
}

struct ImportTimes {
  Spent write, look, bring, add;
};

/// All but the last step of an import.
Status Prepare(MapImport& import, const fs::path& path, ImportTimes& times) {
  const auto size = static_cast<double>(fs::file_size(path));
  times.write.bytes = times.look.bytes = times.bring.bytes = times.add.bytes = size;
  const Status written = times.write.Time([&]() -> Status {
    std::FILE* in = std::fopen(path.c_str(), "rb");
    if (in == nullptr) return Unavailable("cannot read " + path.string());
    std::string part(kPart_bytes, '\0');
    Status status;
    for (std::size_t num_read = 1; status.ok() && num_read > 0;) {
      num_read = std::fread(part.data(), 1, part.size(), in);
      status = import.Write(std::string_view(part).substr(0, num_read));
    }
    std::fclose(in);
    return status;
  });
  DHPMAP_RETURN_IF_ERROR(written);
  DHPMAP_RETURN_IF_ERROR(times.look.Time([&] { return import.LookThrough({}).status(); }));
  return times.bring.Time([&] { return import.Bring({}); });
}

Status Import(MapStore& store, const fs::path& path, const std::string& name, ImportTimes& times) {
  Lane bulk({.name = "bulk", .niceness = kBulkNiceness});
  DHPMAP_ASSIGN_OR_RETURN(const auto import, store.ImportMap());
  DHPMAP_RETURN_IF_ERROR(RunIn(bulk, [&] { return Prepare(*import, path, times); }));
  return times.add.Time([&] { return import->Add(name); });
}

/// Of each store operation on the map called "bench".
Status MeasureAlone(MapStore& store, const fs::path& file, const Spent& commit) {
  DHPMAP_ASSIGN_OR_RETURN(const double bytes, StoredBytes(store, "bench"));
  std::printf("%-38s %9s %9s %9s %10s %10s\n", "", "MB", "s", "cpu s", "MB/s", "MB/cpu s");
  PrintRow("commit, all of them", commit);
  Spent load{.bytes = bytes}, verify{.bytes = bytes}, out;
  DHPMAP_RETURN_IF_ERROR(load.Time([&] { return store.LoadMap("bench").status(); }));
  PrintRow("load", load);
  DHPMAP_RETURN_IF_ERROR(verify.Time([&] { return store.VerifyMap("bench", false, {}).status(); }));
  PrintRow("verify", verify);
  DHPMAP_RETURN_IF_ERROR(Export(store, file, out));
  PrintRow("export", out);
  ImportTimes in;
  DHPMAP_RETURN_IF_ERROR(Import(store, file, "alone", in));
  PrintRow("import: take in", in.write);
  PrintRow("import: look through", in.look);
  PrintRow("import: bring blobs", in.bring);
  PrintRow("import: add rows, which commits wait for", in.add);
  DHPMAP_ASSIGN_OR_RETURN(const VerifyReport report, store.VerifyMap("alone", false, {}));
  std::printf("faults of what came in: %lld\n", static_cast<long long>(report.num_faults));
  return store.DeleteMap("alone");
}

/// How long commits of another map wait.
Status MeasureCommitsBeside(MapStore& store, Mapping& other, const fs::path& file, const StoreBenchOptions& options) {
  DHPMAP_RETURN_IF_ERROR(other.Begin());
  std::printf("\n%-38s %9s %9s %9s %10s\n", "commits of another map, ms", "commits", "median", "p99", "longest");
  {
    Committer alone(other, options.commit_every_s);
    std::this_thread::sleep_for(std::chrono::duration<double>(options.alone_s));
    DHPMAP_RETURN_IF_ERROR(alone.Stop());
    alone.Print("alone");
  }
  Committer beside(other, options.commit_every_s);
  for (int n = 0; n < options.repetitions; ++n) {
    ImportTimes times;
    const std::string name = "beside-" + std::to_string(n);
    DHPMAP_RETURN_IF_ERROR(Import(store, file, name, times));
    std::printf("import %d: %.2f s taken in, %.2f s looked through, %.2f s brought, %.3f s added\n", n + 1,
                times.write.wall_s, times.look.wall_s, times.bring.wall_s, times.add.wall_s);
    DHPMAP_RETURN_IF_ERROR(store.DeleteMap(name));
  }
  DHPMAP_RETURN_IF_ERROR(beside.Stop());
  beside.Print("while maps come in, and go");
  return Status::Ok();
}

}  // namespace

Status RunStoreBench(const StoreBenchOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const LoadedFrames loaded,
                          LoadFrames(options.directory, LabelSource::kPredicted, options.num_frames));
  const Folder folder(options.scratch);
  DHPMAP_ASSIGN_OR_RETURN(const auto store, OpenSqliteStore((folder.path / "maps.db").string()));
  DHPMAP_ASSIGN_OR_RETURN(const MapInfo info, InfoFor(*loaded.dataset, "bench", options.voxel_size_m));
  Spent commit;
  {
    Mapping mapping(*store, info, loaded.frames, options.commit_frames);
    DHPMAP_RETURN_IF_ERROR(MakeMap(*store, mapping, options));
    commit = mapping.commit();
  }
  DHPMAP_ASSIGN_OR_RETURN(const StoredMap made, store->GetMap("bench"));
  std::printf("%zu frames a walk, voxel %g m: %lld submaps, %lld blocks, %.1f MB of blobs\n", loaded.frames.size(),
              made.info.config.voxel_size_m, static_cast<long long>(made.num_submaps),
              static_cast<long long>(made.num_tsdf_blocks), static_cast<double>(made.blob_bytes) / kMega);
  const fs::path file = folder.path / "exported";
  DHPMAP_RETURN_IF_ERROR(MeasureAlone(*store, file, commit));
  if (options.repetitions == 0) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(MapInfo other_info, InfoFor(*loaded.dataset, "other", 0));
  Mapping other(*store, std::move(other_info), loaded.frames, 1);
  return MeasureCommitsBeside(*store, other, file, options);
}

}  // namespace dhpmap::bench
