// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "mapping/base/status.h"

namespace dhpmap {

/// A failure in code that cannot return it, such as an unreadable voxel block: thrown through the thread pool to the
/// code that answers the caller with its status (StatusOfException).
class StatusError final : public std::exception {
 public:
  /// Not OK.
  explicit StatusError(Status status) : status_(std::move(status)), text_(status_.ToString()) {}
  [[nodiscard]] const Status& status() const noexcept { return status_; }
  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

 private:
  Status status_;
  std::string text_;
};

}  // namespace dhpmap
