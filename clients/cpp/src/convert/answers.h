// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "dhpmap/answers.h"
#include "dhpmap/result.h"
#include "dhpmap/v1/collision.pb.h"
#include "dhpmap/v1/query_service.pb.h"

// Packed in, columns out. What comes is looked at before it is read: columns of other lengths are Internal.

namespace dhpmap::client {

using Floats = google::protobuf::RepeatedField<float>;

/// x, y, z of each.
void Pack(std::span<const Vector3> points, Floats& packed);
void Pack(std::span<const Sphere> spheres_m, Floats& packed);

/// Appends the answers to so many questions.
Status Append(const v1::PackedDistanceResults& packed, std::size_t count, std::vector<Distance>& out);
Status Append(const v1::PackedPointResults& packed, std::size_t count, std::vector<PointState>& out);
Status Append(const v1::PackedRayResults& packed, std::size_t count, std::vector<RayHit>& out);
Status Append(const v1::PackedCollisionResults& packed, std::size_t count, std::vector<Collision>& out);

BodyCheck FromProto(const v1::CollisionResult& result);
PathCheck FromProto(const v1::TrajectoryResult& result);

}  // namespace dhpmap::client
