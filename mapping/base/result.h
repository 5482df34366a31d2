// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <optional>
#include <utility>

#include "mapping/base/status.h"

namespace dhpmap {

/// A T, or the Status of its failure. Never holds an OK status without a value.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}  // NOLINT(google-explicit-constructor): `return value;` must read well
  Result(Status status) : status_(std::move(status)) {  // NOLINT(google-explicit-constructor)
    assert(!status_.ok() && "a Result without a value needs an error");
    if (status_.ok()) status_ = Internal("a result was made from an OK status");
  }

  [[nodiscard]] bool ok() const { return value_.has_value(); }
  [[nodiscard]] const Status& status() const { return status_; }

  /// Requires ok().
  T& value() & { return *value_; }
  const T& value() const& { return *value_; }
  T&& value() && { return std::move(*value_); }
  T& operator*() & { return *value_; }
  const T& operator*() const& { return *value_; }
  T&& operator*() && { return std::move(*value_); }
  T* operator->() { return &*value_; }
  const T* operator->() const { return &*value_; }

 private:
  std::optional<T> value_;
  Status status_;
};

}  // namespace dhpmap

#define DHPMAP_CONCAT_INNER_(a, b) a##b
#define DHPMAP_CONCAT_(a, b) DHPMAP_CONCAT_INNER_(a, b)

/// `DHPMAP_ASSIGN_OR_RETURN(auto x, Compute())`: x is the value, or the enclosing function returns the error.
#define DHPMAP_ASSIGN_OR_RETURN(lhs, expr) DHPMAP_ASSIGN_OR_RETURN_(DHPMAP_CONCAT_(dhpmap_result_, __LINE__), lhs, expr)
#define DHPMAP_ASSIGN_OR_RETURN_(result, lhs, expr) \
  auto result = (expr);                             \
  if (!result.ok()) return result.status();         \
  lhs = std::move(result).value()
