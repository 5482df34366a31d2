// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

namespace dhpmap {

/// Asks for page after page and puts them together. `call(context, request, response)` is the RPC.
template <typename Request, typename Response, typename Call>
grpc::Status ReadAllPages(Request request, Response& all, Call call) {
  do {
    grpc::ClientContext context;
    Response page;
    grpc::Status status = call(&context, request, &page);
    if (!status.ok()) return status;
    request.set_page_token(page.next_page_token());
    all.MergeFrom(page);
  } while (!request.page_token().empty());
  all.clear_next_page_token();
  return grpc::Status::OK;
}

}  // namespace dhpmap
