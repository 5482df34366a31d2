// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "mapping/base/ids.h"
#include "mapping/base/result.h"
#include "mapping/map/lost_revisions.h"

namespace dhpmap {

/// Where a list stands that is given out in pages: what the next page comes after, and in which state of the map the
/// first one began.
struct PageMark {
  std::uint64_t history_id = 0;  ///< 0: not of one map
  std::int64_t revision = 0;
  std::string after;  ///< key of the last item given out; empty = none yet
};

/// How many items a page of a list has.
struct PageSizes {
  int by_default = 1000;
  int at_most = 1000;
};

/// Gives out one page of a list. Keys ascend, so that whatever changes between two pages, nothing comes twice, and
/// nothing is left out that was there all the time. Thread-compatible.
class Pager {
 public:
  /// A page may go beyond by one item: far below the 4 MiB that clients of gRPC take by default.
  static constexpr std::size_t kMaxBytes = 1 << 20;

  /// `request` has page_size and page_token; its token must come from a page of the same request. `now` is the present
  /// state, `lost` what it has not in its past. INVALID_ARGUMENT for a negative size or another token; OUT_OF_RANGE,
  /// reason HISTORY_LOST, if the token is of a state that was lost, or of another history.
  template <typename Request>
  static Result<Pager> Begin(const Request& request, const PageMark& now, const LostRevisions& lost = {},
                             PageSizes sizes = {}) {
    Request bound = request;
    bound.clear_page_size();
    bound.clear_page_token();
    return Begin(request.page_size(), request.page_token(), bound, now, lost, sizes);
  }

  /// Empty: from the beginning.
  [[nodiscard]] const std::string& after() const { return mark_.after; }
  /// How many items to get ready: one more than fit, to know whether there is a next page.
  [[nodiscard]] std::size_t num_wanted() const { return static_cast<std::size_t>(max_items_) + 1; }

  /// Whether an item goes into this page; once false, NextToken() tells where to go on.
  bool Takes(const google::protobuf::Message& item, std::string key);
  /// Ends the page at an item that was looked at and passed over: the next one begins behind it.
  void EndBehind(std::string key);
  /// Empty if every item was taken.
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

/// INVALID_ARGUMENT for a token that is not of the list it is given to.
Status BadPageToken();

/// The submap that a page of submaps comes after; nothing for the first. INVALID_ARGUMENT if the token names none.
Result<std::optional<SubmapId>> SubmapIdFromPage(const Pager& pager);
/// The same of a page whose keys are revisions.
Result<std::optional<std::int64_t>> RevisionFromPage(const Pager& pager);

}  // namespace dhpmap
