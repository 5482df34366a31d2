// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <stdexcept>
#include <utility>

#include "dhpmap/status.h"

namespace dhpmap::client {

/// Thrown by Result::value on an error.
class BadResult : public std::runtime_error {
 public:
  explicit BadResult(Status status) : std::runtime_error(status.ToString()), status_(std::move(status)) {}
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  Status status_;
};

/// A T, or the Status of the failure. A value.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}         // NOLINT(google-explicit-constructor): `return value;`
  Result(Status status) : status_(std::move(status)) {  // NOLINT(google-explicit-constructor)
    if (status_.ok()) status_ = {StatusCode::kInternal, "a result was made from an OK status", {}, {}, {}};
  }

  [[nodiscard]] bool ok() const { return value_.has_value(); }
  explicit operator bool() const { return ok(); }
  /// OK if there is a value.
  [[nodiscard]] const Status& status() const { return status_; }

  // Require ok().
  T& operator*() & { return *value_; }
  const T& operator*() const& { return *value_; }
  T operator*() && { return *std::move(value_); }  // by value: safe in `for (x : *Find())`
  T* operator->() { return &*value_; }
  const T* operator->() const { return &*value_; }

  /// Throws BadResult on an error; the only function in this library that throws.
  T& value() & { return Checked(), *value_; }
  const T& value() const& { return Checked(), *value_; }
  T value() && { return Checked(), *std::move(value_); }

 private:
  void Checked() const {
    if (!ok()) throw BadResult(status_);
  }

  std::optional<T> value_;
  Status status_;
};

}  // namespace dhpmap::client
