// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "dhpmap/v1/mapping_service.pb.h"
#include "dhpmap/v1/watch_service.pb.h"
#include "server/app/open_map/open_map.h"

namespace dhpmap {

/// Sets the progress of a stream in any of its answers.
void SetProgress(const FeedProgress& progress, v1::IntegrateFramesResponse& answer);

/// The answer to the client's message `sequence`, which had no frame.
v1::IntegrateFramesResponse AnswerOf(std::int64_t sequence, const FeedProgress& progress);

/// The acknowledgement of the client's frame `sequence`.
v1::IntegrateFramesResponse AckOf(std::int64_t sequence, const FrameOutcome& outcome);

v1::FrameWarning ToProto(const FrameWarning& warning);
v1::FinishMappingResponse ToProto(const FinishOutcome& outcome);
v1::FeedSession ToProto(const SessionStatus& status, const std::string& map);
v1::FinishProgress ToProto(const FinishProgress& progress);

}  // namespace dhpmap
