// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"
#include "server/app/open_map/shutting_down.h"

namespace dhpmap {

/// A client's stream that goes on until somebody ends it.
class OpenStream {
 public:
  /// Ends it with `reason`, as soon as it may; from any thread.
  virtual void Stop(const Status& reason) = 0;

 protected:
  ~OpenStream() = default;
};

/// The streams of one kind that are open, so that a shutdown can end them. Thread-safe.
class OpenStreams {
 public:
  /// Ends every stream, and those that come later, with ShuttingDown.
  void StopAll() DHPMAP_EXCLUDES(mutex_);

  /// False if it is too late. Each is removed before it goes.
  bool Add(OpenStream* stream) DHPMAP_EXCLUDES(mutex_);
  void Remove(OpenStream* stream) DHPMAP_EXCLUDES(mutex_);

 private:
  Mutex mutex_;
  std::set<OpenStream*> streams_ DHPMAP_GUARDED_BY(mutex_);
  bool is_stopped_ DHPMAP_GUARDED_BY(mutex_) = false;
};

}  // namespace dhpmap
