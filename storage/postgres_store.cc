// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres_store.h"

#include <chrono>
#include <thread>
#include <utility>

#include "mapping/map/history_id.h"
#include "storage/check/verify.h"
#include "storage/commit/store_number.h"
#include "storage/files/backup.h"
#include "storage/files/map_import.h"
#include "storage/files/transit_folder.h"
#include "storage/postgres/check/repair.h"
#include "storage/postgres/check/rows_to_verify.h"
#include "storage/postgres/commit/writer.h"
#include "storage/postgres/fleet/fleet_member.h"
#include "storage/postgres/fleet/peers.h"
#include "storage/postgres/fleet/takeover.h"
#include "storage/postgres/fleet/upgrade.h"
#include "storage/postgres/following/later_state.h"
#include "storage/postgres/history/change_reader.h"
#include "storage/postgres/history/edit_reader.h"
#include "storage/postgres/history/undo_reader.h"
#include "storage/postgres/owners/map_ownership.h"
#include "storage/postgres/pool.h"
#include "storage/postgres/reading/catalog.h"
#include "storage/postgres/reading/map_reader.h"
#include "storage/postgres/reading/one_state.h"
#include "storage/postgres/reading/page_reader.h"
#include "storage/postgres/schema.h"
#include "storage/postgres/transit/map_arrival.h"
#include "storage/postgres/transit/map_export.h"
#include "storage/postgres/transit/removal.h"

namespace dhpmap {
namespace {

using postgres::Connection;

postgres::ConnectionOptions ConnectionOptionsOf(const std::string& url, const PostgresStoreOptions& options,
                                                std::int64_t server) {
  return {.url = url,
          .schema = options.schema,
          .application = postgres::ApplicationName(server),
          .patience = std::chrono::milliseconds(static_cast<std::int64_t>(options.answer_s * 1000))};
}

std::vector<postgres::SchemaStep> StepsOf(const PostgresStoreOptions& options) {
  std::vector<postgres::SchemaStep> steps = postgres::ReleasedSteps();
  for (const std::string& sql : options.later_steps) steps.push_back({steps.back().number + 1, sql});
  return steps;
}

postgres::SchemaOpening SchemaOpeningOf(const PostgresStoreOptions& options) {
  return {
      .schema = options.schema,
      .pause =
          options.fleet.await_beats
              ? options.fleet.await_beats
              : [lease_s =
                     options.fleet.lease_s] { std::this_thread::sleep_for(std::chrono::duration<double>(lease_s)); },
      .on_progress = options.on_progress};
}

class PostgresStore final : public MapStore {
 public:
  PostgresStore(const postgres::ConnectionOptions& connection, const PostgresStoreOptions& options, std::int64_t server,
                std::unique_ptr<postgres::Schema> schema)
      : limits_{options.changes, options.edits, options.dead_grace_s},
        schema_(std::move(schema)),
        connecting_(connection),
        pool_(connecting_, options.max_connections),
        peers_(server, options.fleet.lease_s, options.fleet.time_ns),
        maps_(pool_, peers_, options.passing_time_ns),
        writer_(pool_, maps_, limits_, connecting_.patience),
        fleet_(pool_, peers_, maps_, *schema_, connecting_),
        transit_(options.transit_folder),
        pages_(options.pages_tiles ? std::make_shared<postgres::PageReader>(connecting_, options.max_connections)
                                   : nullptr),
        sweeper_(pool_) {}
  ~PostgresStore() override {
    if (pages_ != nullptr) pages_->Close();
  }
  PostgresStore(const PostgresStore&) = delete;
  PostgresStore& operator=(const PostgresStore&) = delete;

  Status Start(const FleetOptions& fleet) { return fleet_.Start(fleet.address, fleet.version, fleet.beats_by_itself); }
  [[nodiscard]] Fleet* fleet() override { return &fleet_; }

  Result<std::vector<StoredMap>> ListMaps(const std::string& after, std::size_t max) override {
    return pool_.Read<std::vector<StoredMap>>([&](Connection& c) { return postgres::ListCatalog(c, after, max); });
  }
  Result<std::vector<std::string>> ListMapNames(const std::string& after, std::size_t max) override {
    return pool_.Read<std::vector<std::string>>([&](Connection& c) { return postgres::ListNames(c, after, max); });
  }
  Result<StoredMap> GetMap(const std::string& name) override {
    return pool_.Read<StoredMap>([&](Connection& c) { return postgres::FindInCatalog(c, name); });
  }

  /// Who loads a map will write it.
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override {
    DHPMAP_ASSIGN_OR_RETURN(const std::shared_ptr<postgres::OwnedMap> map,
                            maps_.Own(name, postgres::MapOwnership::For::kLoading));
    auto state = pool_.Read<std::shared_ptr<const MapSnapshot>>([&](Connection& c) {
      ThreadPool threads(NumCodecThreads());
      return postgres::ReadMapState(c, name, map->key, map->number, threads, pages_);
    });
    if (state.status().code() == StatusCode::kNotFound) maps_.Drop(*map);
    return state;
  }

  Result<StateToRead> LoadToRead(const std::string& name) override {
    return pool_.Read<StateToRead>([&](Connection& c) {
      ThreadPool threads(NumCodecThreads());
      return postgres::ReadState(c, name, threads);
    });
  }
  /// What cannot be followed, for whatever reason, is read anew: that shows what is wrong, if it is.
  Result<StateToRead> ReadSince(const StateToRead& before) override {
    const auto later = pool_.Read<std::optional<StateToRead>>([&](Connection& c) {
      ThreadPool threads(NumCodecThreads());
      return postgres::ReadLaterState(c, before, threads);
    });
    const bool is_followed = later.ok() ? later->has_value() : later.status().code() != StatusCode::kDataLoss;
    if (!is_followed) return LoadToRead(before.snapshot->info().name);
    if (!later.ok()) return later.status();
    return **later;
  }

  Status CreateMap(const MapSnapshot& snapshot) override { return writer_.Create(snapshot); }
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability) override {
    return writer_.Commit({before, after});
  }
  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    return writer_.Commit({before, after, &edit});
  }
  Status Reserve(const std::string& name, const NumberMarks& marks) override { return writer_.Reserve(name, marks); }
  Status DeleteMap(const std::string& name) override {
    Status deleted = writer_.Delete(name);
    if (deleted.ok()) sweeper_.Notify();
    return deleted;
  }

  Result<ChangeList> ListChanges(const std::string& name, std::int64_t after_revision, std::size_t max_bytes) override {
    return pool_.Read<ChangeList>(
        [&](Connection& c) { return postgres::ReadChangeList(c, name, after_revision, max_bytes); });
  }
  Result<std::vector<LoggedEdit>> ListEdits(const std::string& name, const EditQuery& query) override {
    return pool_.Read<std::vector<LoggedEdit>>([&](Connection& c) { return postgres::ReadEditLog(c, name, query); });
  }
  Result<std::optional<StoredAnswer>> FindAnswer(const std::string& name, const std::string& request_id) override {
    return pool_.Read<std::optional<StoredAnswer>>(
        [&](Connection& c) { return postgres::ReadStoredAnswer(c, name, request_id); });
  }
  Result<StateDelta> LoadEdit(const std::string& name, std::int64_t revision) override {
    const auto map = maps_.Find(name);
    const std::uint16_t number = map != nullptr ? map->number : std::uint16_t{0};
    return pool_.Read<StateDelta>([&](Connection& c) { return postgres::ReadEditDelta(c, name, revision, number); });
  }

  /// On a connection of its own, as are exports and imports: those of the pool are for what is quick.
  Result<VerifyReport> VerifyMap(const std::string& name, bool repair, const std::stop_token& stop) override {
    DHPMAP_ASSIGN_OR_RETURN(Connection connection, Connection::OpenForLong(connecting_));
    postgres::RowsToVerify rows(connection, name);
    DHPMAP_ASSIGN_OR_RETURN(Verification found, VerifyOneState(connection, rows, stop));
    if (!repair || found.report.num_faults == 0) return std::move(found.report);
    return RepairDamaged(connection, name, stop);
  }
  Result<std::unique_ptr<StoreBackup>> Backup(const std::stop_token&) override {
    return FailedPrecondition("the store is a PostgreSQL database: its own tools back it up").WithReason("NOT_A_FILE");
  }
  Result<std::unique_ptr<StoreBackup>> ExportMap(const std::string& name, const std::stop_token& stop) override {
    DHPMAP_ASSIGN_OR_RETURN(const std::string place, transit_.NewPlace());
    DHPMAP_ASSIGN_OR_RETURN(Connection connection, Connection::OpenForLong(connecting_));
    DHPMAP_RETURN_IF_ERROR(postgres::WriteMapFileOf(connection, name, place, stop));
    return OpenOnce(place);
  }
  Result<std::unique_ptr<MapImport>> ImportMap() override {
    DHPMAP_ASSIGN_OR_RETURN(std::string place, transit_.NewPlace());
    return BeginMapImport(std::move(place), [this](MapFile file) -> std::unique_ptr<MapTaker> {
      return std::make_unique<postgres::MapArrival>(std::move(file), pool_, connecting_, [this] { sweeper_.Notify(); });
    });
  }

 private:
  static Result<Verification> VerifyOneState(Connection& connection, postgres::RowsToVerify& rows,
                                             const std::stop_token& stop) {
    DHPMAP_ASSIGN_OR_RETURN(const postgres::OneState one_state, postgres::OneState::Begin(connection));
    return Verify(rows, VerifyScope::kAll, stop);
  }

  /// Once the map is ours: looked through anew, as its last owner may have written on. DATA_LOSS if its own row is
  /// damaged.
  Result<VerifyReport> RepairDamaged(Connection& connection, const std::string& name, const std::stop_token& stop) {
    DHPMAP_ASSIGN_OR_RETURN(const std::shared_ptr<postgres::OwnedMap> map,
                            maps_.Own(name, postgres::MapOwnership::For::kLoading));
    const MutexLock lock(map->mutex);
    postgres::RowsToVerify rows(connection, name);
    DHPMAP_ASSIGN_OR_RETURN(Verification found, VerifyOneState(connection, rows, stop));
    if (found.report.num_faults > 0) {
      DHPMAP_RETURN_IF_ERROR(postgres::RepairMap(connection, *map, rows.map(), found));
      sweeper_.Notify();
    }
    return std::move(found.report);
  }

  const postgres::KeepingLimits limits_;
  const std::unique_ptr<postgres::Schema> schema_;
  const postgres::ConnectionOptions connecting_;
  postgres::Pool pool_;
  postgres::Peers peers_;
  postgres::MapOwnership maps_;
  postgres::Writer writer_;
  postgres::FleetMember fleet_;
  TransitFolder transit_;
  const std::shared_ptr<postgres::PageReader> pages_;  // null: maps are read as a whole
  postgres::Sweeper sweeper_;                          // last, as it uses the others
};

}  // namespace

bool IsPostgresUrl(const std::string& db) { return db.starts_with("postgresql://") || db.starts_with("postgres://"); }

Result<std::unique_ptr<MapStore>> OpenPostgresStore(const std::string& url, const PostgresStoreOptions& options) {
  const auto server = static_cast<std::int64_t>(DrawHistoryId());  // random, so that no two processes have the same
  const postgres::ConnectionOptions connecting = ConnectionOptionsOf(url, options, server);
  auto schema = std::make_unique<postgres::Schema>(StepsOf(options));
  {
    DHPMAP_ASSIGN_OR_RETURN(Connection connection, Connection::Open(connecting));
    DHPMAP_RETURN_IF_ERROR(postgres::OpenSchema(connection, *schema, SchemaOpeningOf(options)));
  }
  auto store = std::make_unique<PostgresStore>(connecting, options, server, std::move(schema));
  DHPMAP_RETURN_IF_ERROR(store->Start(options.fleet));
  return std::unique_ptr<MapStore>(std::move(store));
}

}  // namespace dhpmap
