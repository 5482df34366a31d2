// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/rig/clients/connection.h"
#include "tests/rig/clients/corridor.h"
#include "tests/rig/ledger/ledger.h"

namespace dhpmap::rig {

/// A client that works on a server until the connection is lost, and goes on with the next life of it. It remembers
/// what it was told over all lives. Thread-compatible.
class Client {
 public:
  Client(std::uint64_t seed, Ledger& ledger) : ledger_(ledger), random_(seed) {}
  virtual ~Client() = default;
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  virtual void Run(const Life& life) = 0;

 protected:
  /// 0 to n - 1.
  int Any(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  bool Happens(int percent) { return Any(100) < percent; }
  template <typename List>
  auto& AnyOf(List& list) {
    return list[Any(static_cast<int>(list.size()))];
  }
  std::uint64_t Random() { return random_(); }

  Ledger& ledger_;

 private:
  std::mt19937_64 random_;
};

/// Streams the frames of one session into one map, some streams to their end, and finishes mapping now and then.
class FeedingClient : public Client {
 public:
  /// `map`: its place in Life::maps.
  FeedingClient(int map, const Corridor& corridor, std::uint64_t seed, Ledger& ledger)
      : Client(seed, ledger), map_(map), corridor_(corridor) {}
  void Run(const Life& life) override;

 private:
  using Stream = grpc::ClientReaderWriter<v1::IntegrateFramesRequest, v1::IntegrateFramesResponse>;
  bool FeedOneStream(const Life& life, Connection& server);
  bool SendFrames(const Life& life, std::int64_t first, Stream& stream);
  bool ReadAck(const FedMap& map, std::int64_t sequence, Moment asked, Stream& stream);
  bool FinishMapping(const FedMap& map, Connection& server);

  const int map_;
  const Corridor& corridor_;
};

/// Copies, moves, relabels, renames and deletes objects, with etags read just before, long ago or not at all; makes,
/// renames and deletes a small map of its own.
class EditingClient : public Client {
 public:
  EditingClient(int number, std::uint64_t seed, Ledger& ledger)
      : Client(seed, ledger), number_(number), small_map_("maps/small-" + std::to_string(number)) {}
  void Run(const Life& life) override;
  [[nodiscard]] const std::string& small_map() const { return small_map_; }

 private:
  struct ReadState {
    std::string history;
    v1::Submap submap;
  };
  bool EditSubmaps(const FedMap& map, Connection& server);
  std::optional<ReadState> Choose(const FedMap& map, const v1::ListSubmapsResponse& all, bool& with_etag);
  void Remember(const std::string& history, const v1::Submap& submap);
  SubmapEdit Plan(const FedMap& map, const ReadState& read, bool with_etag, std::string what);
  bool Copy(const FedMap& map, const ReadState& read, bool with_etag, Connection& server);
  bool Update(const FedMap& map, const ReadState& read, bool with_etag, Connection& server);
  bool Delete(const FedMap& map, const ReadState& read, bool with_etag, Connection& server);
  bool Settle(EditId edit, const Outcome& outcome, const v1::Submap* after, std::int64_t map_revision);

  bool EditSmallMap(Connection& server);
  bool LookAtSmallMap(Connection& server);
  bool CreateSmallMap(Connection& server);
  bool RenameSmallMap(Connection& server);
  bool DeleteSmallMap(Connection& server);
  std::string ChooseSmallEtag(bool& is_stale);
  bool SettleSmall(EditId edit, const Outcome& outcome, bool is_stale, const v1::Map* after);
  bool DeleteWhatIsOver(const Life& life, Connection& server);

  std::string NewName() { return EditBook::kMark + std::to_string(number_) + "-" + std::to_string(num_names_++); }

  const int number_;
  const std::string small_map_;
  int num_names_ = 0;
  std::vector<ReadState> read_;
  std::optional<v1::Map> small_;  // as last answered; nothing: it is not there
  std::vector<std::string> small_etags_;
};

/// Reads whatever there is, in every way.
class ReadingClient : public Client {
 public:
  using Client::Client;
  void Run(const Life& life) override;

 private:
  bool ReadOnce(const FedMap& map, Connection& server);
  bool ReadAll(const FedMap& map, Connection& server);
  bool ReadOne(const FedMap& map, Connection& server);
  bool ReadMap(const FedMap& map, Connection& server);
  bool ReadPages(const FedMap& map, Connection& server);
  bool AskWithOldToken(const FedMap& map, Connection& server);
  bool ReadVoxels(const FedMap& map, Connection& server);
  Outcome Get(const std::string& name, Connection& server, v1::GetSubmapResponse& response);

  std::int64_t highest_id_ = 1;
};

}  // namespace dhpmap::rig
