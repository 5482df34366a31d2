// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/cpp/calls/caller.h"

namespace dhpmap::client {

/// Calls `take(page)` for each page until there are no more or it returns false. Each page is one call, with the
/// deadline and retries of Caller::Call.
template <typename Stub, typename Request, typename Response, typename Take>
Status ForEachPage(Caller& caller, grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                   Request request, Take take, Again again = Again::kYes) {
  while (true) {
    Result<Response> page = caller.Call(method, request, 0, again);
    if (!page.ok()) return page.status();
    request.set_page_token(page->next_page_token());
    if (!take(*page) || request.page_token().empty()) return {};
  }
}

/// All pages, joined.
template <typename Stub, typename Request, typename Response>
Result<Response> ReadAllPages(Caller& caller,
                              grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                              const Request& request, Again again = Again::kYes) {
  Response all;
  const auto add = [&all](const Response& page) {
    all.MergeFrom(page);
    return true;
  };
  if (Status status = ForEachPage(caller, method, request, add, again); !status.ok()) return status;
  all.clear_next_page_token();
  return all;
}

}  // namespace dhpmap::client
