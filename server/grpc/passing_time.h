// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpc/support/time.h>
#include <grpcpp/server_context.h>

#include <chrono>

namespace dhpmap {

// gRPC's alarms, deadlines and timeouts on the monotonic clock: setting the system's clock does not move them.

/// For grpc::Alarm::Set and grpc::Server::Shutdown.
inline gpr_timespec GrpcTimeIn(std::chrono::nanoseconds from_now) {
  return gpr_time_add(gpr_now(GPR_CLOCK_MONOTONIC), gpr_time_from_nanos(from_now.count(), GPR_TIMESPAN));
}

/// When the call's client stops waiting, but `latest` at the latest.
inline std::chrono::steady_clock::time_point DeadlineOf(const grpc::CallbackServerContext& call,
                                                        std::chrono::nanoseconds latest) {
  const gpr_timespec left = gpr_convert_clock_type(call.raw_deadline(), GPR_TIMESPAN);
  const gpr_timespec most = gpr_time_from_nanos(latest.count(), GPR_TIMESPAN);
  const gpr_timespec least = gpr_time_cmp(left, most) < 0 ? left : most;
  return std::chrono::steady_clock::now() + std::chrono::milliseconds(gpr_time_to_millis(least));
}

}  // namespace dhpmap
