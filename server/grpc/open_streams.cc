// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/open_streams.h"

namespace dhpmap {

void OpenStreams::StopAll() {
  const MutexLock lock(mutex_);
  is_stopped_ = true;
  for (OpenStream* stream : streams_) stream->Stop(ShuttingDown());
}

bool OpenStreams::Add(OpenStream* stream) {
  const MutexLock lock(mutex_);
  if (!is_stopped_) streams_.insert(stream);
  return !is_stopped_;
}

void OpenStreams::Remove(OpenStream* stream) {
  const MutexLock lock(mutex_);
  streams_.erase(stream);
}

}  // namespace dhpmap
