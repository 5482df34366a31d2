// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "mapping/base/status.h"
#include "mapping/base/status_error.h"

// For threads that must outlive whatever goes wrong in one job, such as an allocation that fails.
namespace dhpmap {

/// Its text is so short that it takes no memory.
inline Status OutOfMemory() { return ResourceExhausted("out of memory").WithReason("OUT_OF_MEMORY"); }

/// Where the system gives no thread: for want of address space, too.
inline Status NoThread() {
  return ResourceExhausted("the system has no thread for this: try again later").WithReason("TOO_BUSY");
}

/// Of the exception that is being handled: OutOfMemory, NoThread, what a StatusError says, or INTERNAL for any other.
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

/// What `work` gives, or StatusOfException if it throws.
template <typename Outcome, typename Work>
Outcome Guarded(Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (...) {
    return Outcome(StatusOfException());
  }
}

/// A copy, or OutOfMemory where there is none for its text: so whoever waits is answered.
inline Status CopyOf(const Status& status) noexcept {
  return Guarded<Status>([&status] { return status; });
}

/// Tells somebody whose failure must not become the teller's: what `call` throws ends here.
template <typename Call>
void TellSafely(Call&& call) noexcept {
  try {
    std::forward<Call>(call)();
  } catch (...) {
    // Whoever is called answers for it.
  }
}

}  // namespace dhpmap
