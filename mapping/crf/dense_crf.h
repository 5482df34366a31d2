// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>

#include "mapping/base/thread_pool.h"
#include "mapping/labels/color.h"

namespace dhpmap {

/// A point of the CRF: a voxel.
struct CrfPoint {
  Eigen::Vector3f
      position_m;  ///< relative to any origin near enough for single precision at a fraction of a kernel's width
  Color color;
};

/// One Gaussian kernel k_m with its weight w_m (eq. (5)): range and strength of a point's influence on others.
struct CrfKernel {
  double position_m = 0;  ///< standard deviation in space
  double color = 0;       ///< standard deviation of each of r, g and b, in 0..255; not used by the smoothness kernel
  double weight = 0;      ///< relative to the point's own unaries; 0 disables the kernel
};

/// Sizes of the lattices and their build times, for reports; 0 for disabled kernels.
struct CrfBuildReport {
  std::size_t num_smoothness_vertices = 0, num_appearance_vertices = 0;
  double sort_s = 0, smoothness_s = 0, appearance_s = 0;
};

/// The fully connected CRF of the paper (II-E, eq. (1) to (5); Kraehenbuehl and Koltun 2011): the label of every point
/// speaks for the same label at all other points, by Gaussian kernels k_m of their distance in space and colour (eq.
/// (5), with the distances squared as in a Gaussian) and the Potts model (eq. (4)). With K~_m = D_m^-1/2 K_m D_m^-1/2,
/// where D_m = diag(K_m 1) and K_m holds the self term too, and unaries U = -log p (eq. (3)):
///
///   Q <- softmax(-U),   then n times   Q <- softmax(-U + sum_m w_m K~_m Q)        (all points at once)
///
/// whose label of largest Q approximates the one of least energy, which is that of greatest P (eq. (1) and (2)).
/// The rows of K~_m add up to about 1, so all kernels together cannot overrule unaries that differ by more than the sum
/// of their weights. The sums over all points are filtered on permutohedral lattices (see there for how exactly), which
/// are built once for all kinds of labels. The result is bit-identical for any number of threads; the order of the
/// points decides roundings only. An object keeps its memory from one use to the next. Not for concurrent callers; the
/// pool must outlive it.
class DenseCrf {
 public:
  explicit DenseCrf(ThreadPool& pool);
  ~DenseCrf();
  DenseCrf(DenseCrf&&) noexcept;
  DenseCrf& operator=(DenseCrf&&) noexcept;

  /// Takes the points (they are not needed afterwards) and builds a lattice for each kernel whose weight is not 0.
  CrfBuildReport SetPoints(std::span<const CrfPoint> points, const CrfKernel& smoothness, const CrfKernel& appearance);

  /// Mean field for several kinds of labels at once, such as classes and instances: they do not influence each other,
  /// and each has its own unaries and its own softmax. `num_labels` has the number of labels of each kind, L in all.
  ///   - In: `values[point * L + label]`, a kind's labels together, is the unary U = -log p. +infinity (or NaN) makes a
  ///     label impossible. If all labels of a kind are impossible at a point, the point knows nothing: all count alike.
  ///   - Out: the marginals Q of the same point and label; they add up to 1 over each kind.
  void Infer(std::span<const int> num_labels, int iterations, std::span<float> values);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap
