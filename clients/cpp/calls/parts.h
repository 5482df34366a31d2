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

/// The answer to one request, in parts. For one thread, except Cancel.
template <typename Part>
class Parts {
 public:
  /// `introduce(context)` adds the credentials, `begin(&context)` starts the call.
  template <typename Introduce, typename Begin>
  Parts(std::string address, Introduce introduce, Begin begin) : address_(std::move(address)) {
    introduce(context_);
    reader_ = begin(&context_);
  }
  ~Parts() { Cancel(); }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  /// Waits for the next part; false: there are no more, and Finish returns the status.
  bool Next(Part& part) { return reader_->Read(&part); }
  Status Finish() { return StatusOf(reader_->Finish(), address_); }
  /// Cancels the call: Next returns no more parts, even if it is waiting. Callable from any thread.
  void Cancel() { context_.TryCancel(); }

 private:
  const std::string address_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<Part>> reader_;
};

}  // namespace dhpmap::client
