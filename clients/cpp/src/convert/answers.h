// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "dhpmap/answers.h"
#include "dhpmap/result.h"
#include "dhpmap/v1/collision.pb.h"
#include "dhpmap/v1/query_service.pb.h"

// Packs questions and unpacks columns of answers. Columns of the wrong length give an Internal error before they are
// read.

namespace dhpmap::client {

using Floats = google::protobuf::RepeatedField<float>;

/// Appends x, y, z of each; of spheres the radius, too.
void Pack(std::span<const Vector3> points, Floats& packed);
void Pack(std::span<const Sphere> spheres_m, Floats& packed);

/// Appends the answers to `count` questions.
Status Append(const v1::PackedDistanceResults& packed, std::size_t count, std::vector<Distance>& out);
Status Append(const v1::PackedPointResults& packed, std::size_t count, std::vector<PointState>& out);
Status Append(const v1::PackedRayResults& packed, std::size_t count, std::vector<RayHit>& out);
Status Append(const v1::PackedCollisionResults& packed, std::size_t count, std::vector<Collision>& out);

BodyCheck FromProto(const v1::CollisionResult& result);
PathCheck FromProto(const v1::TrajectoryResult& result);

}  // namespace dhpmap::client
