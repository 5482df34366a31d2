// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/rig/clients/clients.h"

namespace dhpmap::rig {

/// Makes lists of edits by ApplyEdits, of copies and of what becomes copies, which mapping leaves alone; undoes some of
/// what it has made, in this life of the server or another, and does it again.
class ListEditingClient : public Client {
 public:
  ListEditingClient(int number, std::uint64_t seed, Ledger& ledger)
      : Client(seed, ledger), author_("lists-" + std::to_string(number)) {}
  void Run(const Life& life) override;

 private:
  /// A list as it is built: one edit of the book may take several of the API.
  struct Draft {
    std::string history;
    v1::ApplyEditsRequest request;
    std::vector<SubmapEdit> edits;
    std::vector<int> clones;  ///< of each: where in the request its copy is made; -1: it makes none
  };
  /// A list that was answered OK.
  struct MadeList {
    std::string history, name;  ///< maps/{map}/edits/{revision}
    std::vector<EditId> edits;
    bool is_undone = false;
  };

  bool WorkOn(const FedMap& map, Connection& server);
  bool Look(const FedMap& map, Connection& server, v1::ListSubmapsResponse& all);
  bool ApplyList(const FedMap& map, const v1::ListSubmapsResponse& all, Connection& server);
  void Change(const v1::Submap& submap, Draft& draft);
  void Rename(const v1::Submap& submap, SubmapEdit edit, Draft& draft);
  void Copy(const v1::Submap& original, Draft& draft);
  bool SettleList(const FedMap& map, const Draft& draft, const std::vector<EditId>& ids, const Outcome& outcome,
                  const v1::ApplyEditsResponse& response);

  bool TakeBack(const FedMap& map, Connection& server);
  template <typename Response>
  bool SettleUndo(MadeList& made, const std::vector<EditId>& ids, const Outcome& outcome, const Response& response);

  v1::Pose SomewhereAbove();
  std::string NewName() { return EditBook::kMark + author_ + "-" + std::to_string(num_names_++); }

  const std::string author_;
  int num_names_ = 0;
  std::vector<MadeList> made_;
};

}  // namespace dhpmap::rig
