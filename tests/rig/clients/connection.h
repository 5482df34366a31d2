// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"
#include "tests/rig/ledger/ledger.h"
#include "tests/rig/ledger/phases.h"

namespace dhpmap::rig {

/// A map that is fed, edited and read; in one life of the server it is neither made nor deleted.
struct FedMap {
  std::string name;  ///< "maps/..."
  std::string history;
  bool is_edited = false;  ///< in this life; edits leave little that is fused and not stored
};

/// What clients know of one life of the server, from its start to its end.
struct Life {
  int number = 0;
  std::shared_ptr<grpc::Channel> channel;
  std::vector<FedMap> maps;
  std::vector<std::string> to_be_deleted;  ///< maps that nobody uses any more
  std::atomic<bool> is_ending = false;     ///< from now on a lost connection is no wonder
  mutable CallsUnderWay under_way;
};

enum class Fate { kAnswered, kRefused, kCut };

struct Outcome {
  Fate fate = Fate::kCut;
  std::string reason;  ///< of a refusal
};

/// One client's calls to the server of a life. Complains of errors that nobody may get.
class Connection {
 public:
  Connection(const Life& life, Ledger& ledger);

  /// `call(context)`: one unary call. `expected`: reasons for which it may be refused.
  template <typename Call>
  Outcome Ask(const char* what, std::initializer_list<std::string_view> expected, Call&& call) {
    std::optional<CallUnderWay> counted;
    if (const auto phase = PhaseOfCall(what)) counted.emplace(life_.under_way, *phase);
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kTimeout);
    return Judge(what, expected, call(&context));
  }
  Outcome Judge(const char* what, std::initializer_list<std::string_view> expected, const grpc::Status& status);

  Outcome GetMap(const std::string& name, v1::Map& map);
  /// All submaps, or a page of `page_size`.
  Outcome List(const std::string& map, v1::ListSubmapsResponse& page, int page_size = 0, const std::string& token = "");

  std::unique_ptr<v1::MapService::Stub> maps;
  std::unique_ptr<v1::MappingService::Stub> mapping;
  std::unique_ptr<v1::SubmapService::Stub> submaps;
  std::unique_ptr<v1::EditService::Stub> edits;

  static constexpr std::chrono::seconds kTimeout{60};

 private:
  const Life& life_;
  Ledger& ledger_;
};

/// The last part of a map's name.
std::string MapIdOf(const std::string& name);

}  // namespace dhpmap::rig
