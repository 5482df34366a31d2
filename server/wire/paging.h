// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mapping/base/ids.h"
#include "mapping/base/result.h"
#include "mapping/map/lost_revisions.h"

namespace dhpmap {

/// The position of a paged list: the item after which the next page starts, and the state of the map in which the first
/// page began.
struct PageMark {
  std::uint64_t history_id = 0;  ///< 0: the list is not of one map
  std::int64_t revision = 0;
  std::string after;  ///< key of the last returned item; empty: none yet
};

/// Page sizes of a list.
struct PageSizes {
  int by_default = 1000;
  int at_most = 1000;
};

/// Makes one page of a list. Keys ascend, so despite changes between pages no item comes twice, and none that existed
/// all the time is missing. Thread-compatible.
class Pager {
 public:
  /// A page may exceed this by one item: far below gRPC's default limit of 4 MiB.
  static constexpr std::size_t kMaxBytes = 1 << 20;

  /// `request` has page_size and page_token; the token must come from a page of the same request. `now` is the current
  /// state, `lost` the states that are not in its past. INVALID_ARGUMENT for a negative size or a foreign token;
  /// OUT_OF_RANGE, reason HISTORY_LOST, if the token's state was lost or is of another history.
  template <typename Request>
  static Result<Pager> Begin(const Request& request, const PageMark& now, const LostRevisions& lost = {},
                             PageSizes sizes = {}) {
    Request bound = request;
    bound.clear_page_size();
    bound.clear_page_token();
    return Begin(request.page_size(), request.page_token(), bound, now, lost, sizes);
  }

  /// Empty: start at the beginning.
  [[nodiscard]] const std::string& after() const { return mark_.after; }
  /// Number of items to prepare: one more than fit, to know whether there is a next page.
  [[nodiscard]] std::size_t num_wanted() const { return static_cast<std::size_t>(max_items_) + 1; }

  /// Whether the item fits into this page; once false, NextToken() continues the list.
  bool Takes(const google::protobuf::Message& item, std::string key);
  /// Ends the page after an item that was examined and skipped: the next page starts after it.
  void EndBehind(std::string key);
  /// Empty if every item fitted.
  [[nodiscard]] std::string NextToken() const;

 private:
  static Result<Pager> Begin(int page_size, const std::string& token, const google::protobuf::Message& bound,
                             const PageMark& now, const LostRevisions& lost, PageSizes sizes);

  PageMark mark_;
  std::uint64_t request_fingerprint_ = 0;
  int max_items_ = 0;
  int num_items_ = 0;
  std::size_t num_bytes_ = 0;
  bool is_full_ = false;
};

/// INVALID_ARGUMENT for a token of another list.
Status BadPageToken();

/// The revision of the map that a page with this token was given out at; 0 without one, or for what is no token.
std::int64_t RevisionOfPageToken(std::string_view token);

/// The submap that a page of submaps comes after; nothing for the first. INVALID_ARGUMENT if the token names none.
Result<std::optional<SubmapId>> SubmapIdFromPage(const Pager& pager);
/// The same for pages whose keys are revisions.
Result<std::optional<std::int64_t>> RevisionFromPage(const Pager& pager);

}  // namespace dhpmap
