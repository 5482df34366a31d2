// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"
#include "server/app/open_map/shutting_down.h"

namespace dhpmap {

/// A client's stream that runs until it is stopped.
class OpenStream {
 public:
  /// Ends the stream with `reason` as soon as possible; from any thread.
  virtual void Stop(const Status& reason) = 0;

 protected:
  ~OpenStream() = default;
};

/// The open streams of one kind. A shutdown ends them. Thread-safe.
class OpenStreams {
 public:
  /// Ends every stream, and every later one, with ShuttingDown.
  void StopAll() DHPMAP_EXCLUDES(mutex_);

  /// False after StopAll. A stream removes itself before it is deleted.
  bool Add(OpenStream* stream) DHPMAP_EXCLUDES(mutex_);
  void Remove(OpenStream* stream) DHPMAP_EXCLUDES(mutex_);

 private:
  Mutex mutex_;
  std::set<OpenStream*> streams_ DHPMAP_GUARDED_BY(mutex_);
  bool is_stopped_ DHPMAP_GUARDED_BY(mutex_) = false;
};

}  // namespace dhpmap
