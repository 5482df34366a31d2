// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/kills/kills.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iomanip>
#include <memory>
#include <random>
#include <sstream>
#include <thread>

#include "tests/e2e/server_process.h"
#include "tests/rig/clients/backing_up_client.h"
#include "tests/rig/clients/clients.h"
#include "tests/rig/clients/list_editing_client.h"
#include "tests/rig/kills/migration_kills.h"

namespace dhpmap::rig {
namespace {

using Clock = std::chrono::steady_clock;
using testing::ServerProcess;

constexpr std::size_t kManyComplaints = 20;
constexpr double kEnd_s = 30;
/// How long a server is given to come to what is aimed at.
constexpr double kAim_s = 1;
constexpr std::array kAims = {Phase::kMapping,    Phase::kRefinement, Phase::kEdits,
                              Phase::kCollection, Phase::kBackup,     Phase::kMigration};

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class KillingLoop {
 public:
  explicit KillingLoop(const KillOptions& options)
      : options_(options),
        corridor_(options.num_places),
        random_(options.seed),
        migrations_(options.directory, random_(), [this](const std::string& text) { ledger_.Complain(text); }),
        fed_(options.num_fed_maps) {
    for (int i = 0; i < options.num_fed_maps; ++i) {
      clients_.push_back(std::make_unique<FeedingClient>(i, corridor_, random_(), ledger_));
    }
    for (int i = 0; i < options.num_editors; ++i) {
      auto editor = std::make_unique<EditingClient>(i, random_(), ledger_);
      small_maps_.push_back(editor->small_map());
      clients_.push_back(std::move(editor));
    }
    for (int i = 0; i < options.num_readers; ++i) {
      clients_.push_back(std::make_unique<ReadingClient>(random_(), ledger_));
    }
    for (int i = 0; i < options.num_list_editors; ++i) {
      clients_.push_back(std::make_unique<ListEditingClient>(i, random_(), ledger_));
    }
    auto backing_up = std::make_unique<BackingUpClient>(options.directory / "backup.db", random_(), ledger_);
    backing_up_ = backing_up.get();
    clients_.push_back(std::move(backing_up));
  }

  KillReport Run(std::ostream& progress) {
    while (report_.num_kills < options_.num_kills) {
      const Phase aim = kAims[static_cast<std::size_t>(report_.num_kills) % kAims.size()];
      const bool migrates = aim == Phase::kMigration && options_.migrates;
      if (!(migrates ? MigrateOnce() : LiveOnce(aim))) break;
      Tell(progress);
    }
    if (ledger_.complaints().size() < kManyComplaints) EndWell();
    report_.tally = ledger_.tally();
    report_.complaints = ledger_.complaints();
    return report_;
  }

 private:
  void Tell(std::ostream& progress);
  double Between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool Happens(double share) { return Between(0, 1) < share; }

  std::unique_ptr<ServerProcess> Start();
  bool LiveOnce(Phase aim);
  bool MigrateOnce();
  void EndWell();
  /// What is there after a start, before anybody changes it.
  bool TakeStock(Connection& server);
  bool TakeStockOf(FedMap& map, Connection& server);
  bool TakeStockOfSmallMaps(Connection& server);
  bool MakeMapsWhoseTimeHasCome(Life& life, Connection& server);
  bool Make(FedMap& map, const std::string& name, Connection& server);
  void WorkUntilKilled(Life& life, ServerProcess& server, Phase aim);
  /// Returns when it is time to kill, with what the server was at.
  ByPhase<bool> AwaitTheMoment(const Life& life, ServerProcess& server, Phase aim);
  void LookInto(const FinishedBackup& backup, const Life& life);
  void LookInto(const FinishedBackup& backup, const FedMap& map, Connection& server);

  const KillOptions options_;
  const Corridor corridor_;
  std::mt19937_64 random_;
  Ledger ledger_;
  MigrationKills migrations_;
  std::vector<std::unique_ptr<Client>> clients_;
  BackingUpClient* backing_up_ = nullptr;  // one of them
  std::vector<FedMap> fed_;
  std::vector<std::string> small_maps_;
  int num_lives_ = 0;  ///< of servers that clients worked on
  KillReport report_;
  std::size_t num_told_ = 0;  // complaints
};

void KillingLoop::Tell(std::ostream& progress) {
  const Complaints complaints = ledger_.complaints();
  for (; num_told_ < complaints.size(); ++num_told_) {
    progress << "after " << report_.num_kills << " kills: " << complaints[num_told_] << std::endl;
  }
  if (report_.num_kills % 20 == 0) {
    progress << report_.num_kills << " kills, " << ledger_.tally().num_answers << " answers" << std::endl;
  }
}

std::unique_ptr<ServerProcess> KillingLoop::Start() {
  // How much is fused and not stored when the server dies differs from life to life.
  const int commit_frames = std::array{3, 10, 50}[random_() % 3];
  setenv("DHPMAP_STORE_COMMIT_FRAMES", std::to_string(commit_frames).c_str(), 1);
  setenv("DHPMAP_STORE_COMMIT_S", Happens(0.5) ? "0.3" : "2", 1);
  setenv("DHPMAP_MAPPING_PUBLISH_FRAMES", Happens(0.7) ? "1" : "5", 1);
  const auto start = Clock::now();
  auto server = std::make_unique<ServerProcess>(options_.directory, options_.directory / "maps.db");
  if (report_.num_starts++ > 0) report_.start_s.push_back(SecondsSince(start));
  if (server->is_serving()) return server;
  ledger_.Complain("the server does not start: " + server->process().Stderr());
  return nullptr;
}

bool KillingLoop::MigrateOnce() {
  report_.num_kills_in[Phase::kMigration] += migrations_.KillOnce() ? 1 : 0;
  report_.num_half_migrated = migrations_.num_half_done();
  ++report_.num_kills;
  return ledger_.complaints().size() < kManyComplaints;
}

bool KillingLoop::LiveOnce(Phase aim) {
  const auto server = Start();
  if (!server) return false;
  Life life;
  life.number = num_lives_++;
  life.channel = server->Connect();
  {
    Connection connection(life, ledger_);
    if (!TakeStock(connection) || !MakeMapsWhoseTimeHasCome(life, connection)) return false;
  }
  for (FedMap& map : fed_) map.is_edited = Happens(0.6);
  life.maps = fed_;
  WorkUntilKilled(life, *server, life.to_be_deleted.empty() ? aim : Phase::kCollection);
  return ledger_.complaints().size() < kManyComplaints;
}

ByPhase<bool> KillingLoop::AwaitTheMoment(const Life& life, ServerProcess& server, Phase aim) {
  const auto rest = [](double s) { std::this_thread::sleep_for(std::chrono::duration<double>(s)); };
  constexpr double kLook_s = 0.005, kWithin_s = 0.05;
  rest(Between(options_.min_life_s, options_.max_life_s));
  PhaseWatch watch(server.process().pid(), life.under_way);
  (void)watch.Look();
  const auto start = Clock::now();
  ByPhase<bool> seen;
  while (!seen[aim] && SecondsSince(start) < kAim_s) {
    rest(Between(0, 2 * kLook_s));
    seen = watch.Look();
  }
  if (Happens(0.5)) return seen;  // at its beginning
  rest(Between(0, kWithin_s));
  (void)watch.Look();
  rest(kLook_s);
  return watch.Look();
}

void KillingLoop::WorkUntilKilled(Life& life, ServerProcess& server, Phase aim) {
  std::vector<std::thread> threads;
  for (const auto& client : clients_) threads.emplace_back([&client, &life] { client->Run(life); });
  const ByPhase<bool> seen = AwaitTheMoment(life, server, aim);
  if (const auto exit_code = server.process().Wait(0)) {
    ledger_.Complain("the server ended by itself with " + std::to_string(*exit_code) + ": " +
                     server.process().Stderr());
  }
  life.is_ending = true;
  server.process().Signal(SIGKILL);
  server.process().Wait(kEnd_s);
  for (std::thread& thread : threads) thread.join();
  ++report_.num_kills;
  for (const Phase phase : kAims) report_.num_kills_in[phase] += seen[phase] ? 1 : 0;
  if (const auto backup = backing_up_->Take()) LookInto(*backup, life);
}

void KillingLoop::LookInto(const FinishedBackup& backup, const Life& life) {
  {
    ServerProcess server(options_.directory, backup.file);
    if (!server.is_serving()) {
      return ledger_.Complain("law 6: a backup that was finished does not open: " + server.process().Stderr());
    }
    Life of_backup;
    of_backup.number = life.number;
    of_backup.channel = server.Connect();
    Connection connection(of_backup, ledger_);
    for (const FedMap& map : life.maps) LookInto(backup, map, connection);
    if (server.Terminate() != 0) {
      ledger_.Complain("law 6: a server of a backup does not end well: " + server.process().Stderr());
    }
  }
  for (const char* suffix : {"", "-wal", "-shm", "-lock"}) std::filesystem::remove(backup.file.string() + suffix);
}

void KillingLoop::LookInto(const FinishedBackup& backup, const FedMap& map, Connection& server) {
  v1::VerifyMapRequest request;
  request.set_name(map.name);
  v1::VerifyMapResponse verified;
  const Outcome outcome = server.Ask("VerifyMap of a backup", {}, [&](grpc::ClientContext* context) {
    return server.maps->VerifyMap(context, request, &verified);
  });
  v1::Map summary;
  v1::ListSubmapsResponse all;
  if (outcome.fate != Fate::kAnswered || server.GetMap(map.name, summary).fate != Fate::kAnswered ||
      server.List(map.name, all).fate != Fate::kAnswered) {
    return ledger_.Complain("law 6: a backup has no " + map.name + ", or it cannot be read");
  }
  if (verified.num_faults() > 0) ledger_.Complain("law 6: a backup is damaged: " + verified.ShortDebugString());
  const auto stored = backup.num_stored.find(map.history);
  ledger_.OnBackup(map.history, summary, all, stored == backup.num_stored.end() ? 0 : stored->second, backup.asked,
                   backup.answered);
}

bool KillingLoop::TakeStock(Connection& server) {
  for (FedMap& map : fed_) {
    if (!map.name.empty() && !TakeStockOf(map, server)) return false;
  }
  return TakeStockOfSmallMaps(server);
}

bool KillingLoop::TakeStockOf(FedMap& map, Connection& server) {
  const Moment asked = ledger_.Now();
  v1::Map summary;
  v1::ListSubmapsResponse all;
  if (server.GetMap(map.name, summary).fate != Fate::kAnswered || server.List(map.name, all).fate != Fate::kAnswered) {
    ledger_.Complain("after a restart " + map.name + " cannot be read");
    return false;
  }
  if (summary.history_id() != map.history) {
    ledger_.Complain("a restart began another history of " + map.name);
    return false;
  }
  ledger_.OnRestarted(summary, all, asked);
  return true;
}

bool KillingLoop::TakeStockOfSmallMaps(Connection& server) {
  const Moment asked = ledger_.Now();
  std::map<std::int64_t, v1::Map> there;
  for (std::size_t i = 0; i < small_maps_.size(); ++i) {
    v1::Map map;
    const Outcome outcome = server.GetMap(small_maps_[i], map);
    if (outcome.fate == Fate::kCut) return false;
    if (outcome.fate == Fate::kAnswered) there[static_cast<std::int64_t>(i)] = std::move(map);
  }
  ledger_.OnMapsRestarted(there, asked);
  return true;
}

bool KillingLoop::MakeMapsWhoseTimeHasCome(Life& life, Connection& server) {
  for (std::size_t i = 0; i < fed_.size(); ++i) {
    const int age = life.number + static_cast<int>(i) * options_.lives_of_map / 2;  // not all in one life
    if (!fed_[i].name.empty() && age % options_.lives_of_map != 0) continue;
    const int generation = age / options_.lives_of_map;
    if (!fed_[i].name.empty()) life.to_be_deleted.push_back(fed_[i].name);
    if (!Make(fed_[i], "corridor-" + std::to_string(i) + "-" + std::to_string(generation % 2), server)) return false;
  }
  return true;
}

/// One of before that has the name, and was not deleted in its last life, goes first.
bool KillingLoop::Make(FedMap& map, const std::string& name, Connection& server) {
  v1::DeleteMapRequest old;
  old.set_name("maps/" + name);
  v1::DeleteMapResponse deleted;
  const Outcome outcome = server.Ask("DeleteMap", {"MAP_NOT_FOUND"}, [&](grpc::ClientContext* context) {
    return server.maps->DeleteMap(context, old, &deleted);
  });
  if (outcome.fate == Fate::kCut) return false;
  const v1::CreateMapRequest request = CorridorMap(name, "a corridor");
  v1::CreateMapResponse response;
  const Moment asked = ledger_.Now();
  const Outcome made = server.Ask("CreateMap", {}, [&](grpc::ClientContext* context) {
    return server.maps->CreateMap(context, request, &response);
  });
  if (made.fate != Fate::kAnswered) return false;
  ledger_.OnMap(response.map(), asked);
  map = {.name = response.map().name(), .history = response.map().history_id()};
  return true;
}

/// After the last kill: a clean end loses nothing either.
void KillingLoop::EndWell() {
  for (int i = 0; i < 2; ++i) {
    const auto server = Start();
    if (!server) return;
    Life life;
    life.number = num_lives_ + i;
    life.channel = server->Connect();
    Connection connection(life, ledger_);
    if (!TakeStock(connection)) return;
    const auto exit_code = server->Terminate();
    if (exit_code != 0) ledger_.Complain("SIGTERM did not end the server well: " + server->process().Stderr());
  }
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

KillReport RunKills(const KillOptions& options, std::ostream& progress) { return KillingLoop(options).Run(progress); }

std::string ToText(const KillReport& report) {
  const Tally& tally = report.tally;
  std::ostringstream text;
  text << std::fixed << std::setprecision(3);
  text << "kills                    " << report.num_kills << "\n";
  for (const Phase phase : kAims) {
    text << "  during " << std::left << std::setw(16) << NameOf(phase) << report.num_kills_in[phase] << "\n";
  }
  text << "databases left half brought up to date " << report.num_half_migrated << "\n"
       << "starts on a database     " << report.start_s.size() << ", median " << Median(report.start_s) << " s, max "
       << (report.start_s.empty() ? 0 : *std::max_element(report.start_s.begin(), report.start_s.end())) << " s\n"
       << "answers held against     " << tally.num_answers << ", " << tally.num_listings << " of them whole maps\n"
       << "names of states kept     " << tally.num_names << "\n"
       << "edits made               " << tally.num_edits_made << "\n"
       << "edits refused            " << tally.num_edits_refused << "\n"
       << "edits cut off            " << tally.num_edits_cut << ", of which were made " << tally.num_cut_edits_made
       << "\n"
       << "lists and undos made     " << tally.num_lists_made << ", refused " << tally.num_lists_refused << ", cut off "
       << tally.num_lists_cut << "; undone or done again: " << tally.num_undone << " asked\n"
       << "backups looked into      " << tally.num_backups << " maps\n"
       << "edits with a stale etag  " << tally.num_stale_edits << "\n"
       << "sequences told           " << tally.num_sequences_told << ", sessions resumed " << tally.num_resumed << "\n"
       << "old page tokens asked    " << tally.num_lost_tokens_asked << " of lost states, "
       << tally.num_good_tokens_asked << " of stored ones\n"
       << "violations               " << report.complaints.size() << "\n";
  for (const std::string& complaint : report.complaints) text << "  " << complaint << "\n";
  return text.str();
}

}  // namespace dhpmap::rig
