// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "mapping/base/status.h"
#include "mapping/base/status_error.h"

// For threads that must survive any failure of one job, such as an allocation.
namespace dhpmap {

/// Its short text needs no allocation.
inline Status OutOfMemory() { return ResourceExhausted("out of memory").WithReason("OUT_OF_MEMORY"); }

/// The system cannot start a thread, for lack of address space, too.
inline Status NoThread() {
  return ResourceExhausted("the system has no thread for this: try again later").WithReason("TOO_BUSY");
}

/// For the exception that is being handled: OutOfMemory, NoThread, the status of a StatusError, or INTERNAL.
inline Status StatusOfException() noexcept {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return OutOfMemory();
  } catch (const StatusError& error) {
    try {
      return error.status();
    } catch (...) {
      return OutOfMemory();
    }
  } catch (const std::exception& error) {
    try {
      const auto* system = dynamic_cast<const std::system_error*>(&error);
      if (system != nullptr && system->code() == std::errc::resource_unavailable_try_again) return NoThread();
      return Internal("an internal fault: the log of the server has its cause").WithCause(error.what());
    } catch (...) {
      return OutOfMemory();
    }
  } catch (...) {
    return Internal("unknown failure");
  }
}

/// The result of `work`, or StatusOfException if it throws.
template <typename Outcome, typename Work>
Outcome Guarded(Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (...) {
    return Outcome(StatusOfException());
  }
}

/// A copy, or OutOfMemory if its text cannot be allocated, so that a waiting caller is always answered.
inline Status CopyOf(const Status& status) noexcept {
  return Guarded<Status>([&status] { return status; });
}

/// Calls back and swallows exceptions, for callees whose failure must not affect the caller.
template <typename Call>
void TellSafely(Call&& call) noexcept {
  try {
    std::forward<Call>(call)();
  } catch (...) {
    // The callee is responsible.
  }
}

}  // namespace dhpmap
