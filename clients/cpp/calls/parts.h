// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/support/sync_stream.h>

#include <memory>
#include <string>
#include <utility>

#include "clients/cpp/calls/error.h"
#include "dhpmap/status.h"

namespace dhpmap::client {

/// The answer to one request, part by part. For one thread, but Cancel.
template <typename Part>
class Parts {
 public:
  /// `introduce(context)` says who calls, `begin(&context)` makes the call.
  template <typename Introduce, typename Begin>
  Parts(std::string address, Introduce introduce, Begin begin) : address_(std::move(address)) {
    introduce(context_);
    reader_ = begin(&context_);
  }
  ~Parts() { Cancel(); }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  /// Waits for the next one; false: there are no more, and Finish says why.
  bool Next(Part& part) { return reader_->Read(&part); }
  Status Finish() { return StatusOf(reader_->Finish(), address_); }
  /// Ends it: Next, also one that waits, has no more. Safe from any thread.
  void Cancel() { context_.TryCancel(); }

 private:
  const std::string address_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<Part>> reader_;
};

}  // namespace dhpmap::client
