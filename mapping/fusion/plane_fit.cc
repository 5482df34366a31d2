// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/plane_fit.h"

#include <algorithm>
#include <cmath>

namespace dhpmap {
namespace {

/// Standard deviation along the second axis. Below it the points form a line (a scan's ring, a wire) or a spot, and the
/// plane could turn around them.
constexpr float kLeastSpread_vox = 0.5f;
/// Standard deviation across the plane. Above it there is an edge, or more curvature than a plane should smooth away.
constexpr float kMostThickness_vox = 0.2f;
/// The same as a share of the second variance: noise as wide as the patch has no normal.
constexpr float kMostFlatness = 0.1f;

constexpr float Square(float value) { return value * value; }

}  // namespace

float PlaneFit::SpreadAlong_m(const Eigen::Vector3f& u) const {
  const float variance =
      squares_m2.dot(u.cwiseProduct(u)) +
      2 * (products_m2.x() * u.y() * u.z() + products_m2.y() * u.z() * u.x() + products_m2.z() * u.x() * u.y());
  return std::sqrt(std::max(0.0f, variance));
}

PlaneFit FitPlane(const PlaneMoments& moments, float voxel_size_m) {
  PlaneFit fit;
  const auto& s = moments.sums;
  if (moments.num_bundles() < PlaneFit::kLeastBundles) return fit;
  const double per_weight = 1.0 / s[0];
  const double x = s[1] * per_weight, y = s[2] * per_weight, z = s[3] * per_weight;
  const auto xx = static_cast<float>(s[4] * per_weight - x * x), yy = static_cast<float>(s[5] * per_weight - y * y),
             zz = static_cast<float>(s[6] * per_weight - z * z), yz = static_cast<float>(s[8] * per_weight - y * z),
             zx = static_cast<float>(s[9] * per_weight - z * x), xy = static_cast<float>(s[10] * per_weight - x * y);
  const float cx = yy * zz - yz * yz, cy = xx * zz - zx * zx, cz = xx * yy - xy * xy;
  const float least_variance = Square(kLeastSpread_vox * voxel_size_m);
  const float trace = xx + yy + zz, minors = cx + cy + cz;
  // An upper bound of the second variance, since the first is at least a third of the trace. Most lines end here.
  if (!(3 * minors >= least_variance * trace)) return fit;
  const float det = xx * cx + xy * (yz * zx - xy * zz) + zx * (xy * yz - yy * zx);

  // Newton's method from 0 converges to the smallest root of the characteristic polynomial from below. It is fast if
  // that root is much smaller than the others; otherwise there is no plane.
  float least = 0;
  for (int i = 0; i < 3; ++i) {
    const float slope = (3 * least - 2 * trace) * least + minors;
    const float value = ((least - trace) * least + minors) * least - det;
    least -= slope > 0 ? value / slope : 0.0f;
  }
  const float rest = trace - least, product = minors - least * rest;  // sum and product of the other two roots
  const float second = 0.5f * (rest - std::sqrt(std::max(0.0f, rest * rest - 4 * product)));
  if (!(second >= least_variance)) return fit;
  fit.outcome = PlaneFit::Outcome::kNotFlat;
  if (!(least <= Square(kMostThickness_vox * voxel_size_m) && least <= kMostFlatness * second)) return fit;

  // The adjugate of (covariance - least) is a scaled outer product of the normal with itself: take its longest column.
  const float a = xx - least, b = yy - least, c = zz - least;
  const float aa = b * c - yz * yz, bb = a * c - zx * zx, cc = a * b - xy * xy;
  const float ab = yz * zx - xy * c, ca = xy * yz - zx * b, bc = xy * zx - yz * a;
  const Eigen::Vector3f normal = aa >= bb && aa >= cc ? Eigen::Vector3f(aa, ab, ca)
                                 : bb >= cc           ? Eigen::Vector3f(ab, bb, bc)
                                                      : Eigen::Vector3f(ca, bc, cc);
  const float length = normal.norm();
  if (!(length > 0)) return fit;
  fit.outcome = PlaneFit::Outcome::kPlane;
  fit.normal = normal / length;
  fit.mean_m = Eigen::Vector3d(x, y, z).cast<float>();
  fit.squares_m2 = {xx, yy, zz};
  fit.products_m2 = {yz, zx, xy};
  return fit;
}

}  // namespace dhpmap
