// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/storage/blob_reads.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "storage/postgres/commit/writer.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/owners/map_ownership.h"
#include "storage/postgres/pool.h"
#include "storage/sqlite/database.h"
#include "tests/unit/storage/bench_timing.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap::testing {
namespace {

constexpr std::size_t kMostBlobs = 4000, kKeysAtOnce = 64;
constexpr int kRuns = 7;

double MedianOf_us(std::size_t num_blobs, const std::function<void()>& read) {
  if (num_blobs == 0) return 0;
  std::vector<double> times_us;
  for (int n = 0; n < kRuns; ++n) times_us.push_back(1e3 * TimeOf_ms(read) / static_cast<double>(num_blobs));
  return Quantile(times_us, .5);
}

/// The blobs of one map of a database.
class PostgresBlobs {
 public:
  PostgresBlobs(const std::string& url, const std::string& schema)
      : connection_(Require(postgres::Connection::Open({.url = url, .schema = schema}))) {
    static const std::string largest = "SELECT map_key FROM tile_blobs GROUP BY map_key ORDER BY count(*) DESC LIMIT 1";
    static const std::string keys = "SELECT blob_key FROM tile_blobs WHERE map_key = $1 ORDER BY blob_key LIMIT $2";
    postgres::Answer map = Require(connection_.Query({&largest}, "find a map"));
    if (map.Next()) map_key_ = map.Int();
    postgres::Call call{&keys};
    call.values.Add(map_key_).Add(static_cast<std::int64_t>(kMostBlobs));
    for (postgres::Answer answer = Require(connection_.Query(call, "list blobs")); answer.Next();) {
      keys_.push_back(answer.Int());
    }
  }

  [[nodiscard]] std::size_t size() const { return keys_.size(); }
  void ReadAtOnce(std::size_t num_keys) {
    static const std::string text = "SELECT blob_key, blob FROM tile_blobs WHERE map_key = $1 AND blob_key = ANY ($2)";
    const std::span<const std::int64_t> all(keys_);
    for (std::size_t first = 0; first < all.size(); first += num_keys) {
      postgres::Call call{&text};
      call.values.Add(map_key_).Add(all.subspan(first, std::min(num_keys, all.size() - first)));
      Take(call);
    }
  }
  void ReadOneByOne() {
    static const std::string text = "SELECT blob_key, blob FROM tile_blobs WHERE map_key = $1 AND blob_key = $2";
    for (const std::int64_t key : keys_) {
      postgres::Call call{&text};
      call.values.Add(map_key_).Add(key);
      Take(call);
    }
  }
  void ReadMap() {
    static const std::string text = "SELECT blob_key, blob FROM tile_blobs WHERE map_key = $1 AND blob_key <= $2";
    postgres::Call call{&text};
    call.values.Add(map_key_).Add(keys_.back());
    Require(connection_.Stream(call, "read blobs", [](postgres::Answer& row) {
      (void)row.Int(), (void)row.Blob();
      return Status::Ok();
    }));
  }

 private:
  void Take(const postgres::Call& call) {
    for (postgres::Answer answer = Require(connection_.Query(call, "read blobs")); answer.Next();) {
      (void)answer.Int(), (void)answer.Blob();
    }
  }

  postgres::Connection connection_;
  std::int64_t map_key_ = 0;
  std::vector<std::int64_t> keys_;
};

}  // namespace

BlobReads ReadSqliteBlobs(const std::filesystem::path& file) {
  auto database = Require(sqlite::Database::Open(file.string(), sqlite::OpenMode::kReadOnly, 1000));
  std::vector<std::int64_t> keys;
  auto list = Require(database.Prepare("SELECT blob_key FROM tile_blobs LIMIT ?", "list blobs"));
  list.Bind(static_cast<std::int64_t>(kMostBlobs));
  while (Require(list.Step())) keys.push_back(list.Int(0));
  auto read = Require(database.Prepare("SELECT blob FROM tile_blobs WHERE blob_key = ?", "read a blob"));
  BlobReads reads;
  reads.one_by_one_us = MedianOf_us(keys.size(), [&] {
    for (const std::int64_t key : keys) {
      read.Bind(key);
      if (Require(read.Step())) (void)read.Blob(0);
      read.Reset();
    }
  });
  return reads;
}

BlobReads ReadPostgresBlobs(const std::string& url, const std::string& schema) {
  PostgresBlobs blobs(url, schema);
  return {.one_by_one_us = MedianOf_us(blobs.size(), [&] { blobs.ReadOneByOne(); }),
          .by_64_us = MedianOf_us(blobs.size(), [&] { blobs.ReadAtOnce(kKeysAtOnce); }),
          .by_map_us = MedianOf_us(blobs.size(), [&] { blobs.ReadMap(); })};
}

int CountTripsOfCommits(const std::string& url, const std::string& schema) {
  postgres::Pool pool({.url = url, .schema = schema}, 1);
  postgres::Peers peers(1, 2, {});
  postgres::MapOwnership maps(pool, peers, {});
  postgres::Writer writer(pool, maps, {}, std::chrono::seconds(20));
  MapGenerator generator(5);
  Map map(generator.Info("trips"));
  const SubmapId id = generator.AddSubmap(map, 1).id();
  Require(writer.Create(*map.Publish(1)));
  std::int64_t most = 0;
  for (const int num_tiles : {1, 50, 500, 0}) {
    const auto before = map.published();
    for (int n = 0; n < num_tiles; ++n) {
      generator.FillTsdf(map.FindMutable(id)->MutableTsdf({4 * n, 40, 0}), map.info().config.truncation_m);
    }
    if (num_tiles == 0) map.FindMutable(id)->mutable_info().display_name = "edited";
    const auto after = map.Publish(2 + num_tiles);
    EditRecord edit;
    edit.entry.revision = after->revision();
    edit.entry.source.request_id = "1";
    edit.before = before;
    const std::int64_t trips_before = pool.num_round_trips();
    Require(writer.Commit({StateMarks(*before), *after, num_tiles == 0 ? &edit : nullptr}));
    most = std::max(most, pool.num_round_trips() - trips_before);
  }
  return static_cast<int>(most);
}

}  // namespace dhpmap::testing
