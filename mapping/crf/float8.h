// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Eight floats at a time. Functions marked DHPMAP_VECTOR_CLONES exist for several vector units, chosen at load time
// (not under sanitizers: those start after the choice); what they call must be DHPMAP_ALWAYS_INLINE. The sums are the
// same with every unit. Vectors are never passed by value: that would need one calling convention a unit.

#include <cstdint>

#include "mapping/base/vector_clones.h"

namespace dhpmap {

typedef float Float8 __attribute__((vector_size(32)));
typedef std::int32_t Int8 __attribute__((vector_size(32)));

/// A vector in a row of floats: needs no alignment, and may alias. A struct: clang takes a reference to a vector for
/// one to an aligned vector.
struct [[gnu::packed, gnu::may_alias]] RowVector8 {
  Float8 x;
};
struct [[gnu::packed, gnu::may_alias]] RowMask8 {
  Int8 x;
};

/// The v-th vector of a row, to read or to write.
DHPMAP_ALWAYS_INLINE RowVector8& Vector8(float* row, int v) { return reinterpret_cast<RowVector8*>(row)[v]; }
DHPMAP_ALWAYS_INLINE const RowVector8& Vector8(const float* row, int v) {
  return reinterpret_cast<const RowVector8*>(row)[v];
}

/// The greatest element in all elements.
DHPMAP_ALWAYS_INLINE void SpreadMax(Float8& x) {
  Float8 other = __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3);
  x = x > other ? x : other;
  other = __builtin_shufflevector(x, x, 2, 3, 0, 1, 6, 7, 4, 5);
  x = x > other ? x : other;
  other = __builtin_shufflevector(x, x, 1, 0, 3, 2, 5, 4, 7, 6);
  x = x > other ? x : other;
}

/// The sum of the elements in all elements.
DHPMAP_ALWAYS_INLINE void SpreadSum(Float8& x) {
  x += __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3);
  x += __builtin_shufflevector(x, x, 2, 3, 0, 1, 6, 7, 4, 5);
  x += __builtin_shufflevector(x, x, 1, 0, 3, 2, 5, 4, 7, 6);
}

/// x = exp(x) for x <= 0, -infinity included, to 2 units in the last place; 0 below -87.
DHPMAP_ALWAYS_INLINE void ExpOfNegative(Float8& x) {
  const Int8 is_large = x > -87.0f;
  x = is_large ? x : Float8{} - 87.0f;
  // x = n ln 2 + r with |r| <= ln 2 / 2, ln 2 in two parts; then a polynomial for exp(r).
  const Int8 n = __builtin_convertvector(x * 1.44269504f - 0.5f, Int8);
  const Float8 n_float = __builtin_convertvector(n, Float8);
  const Float8 r = x - n_float * 0.693359375f + n_float * 2.12194440e-4f;
  Float8 y = r * 1.9875691500e-4f + 1.3981999507e-3f;
  y = y * r + 8.3334519073e-3f;
  y = y * r + 4.1665795894e-2f;
  y = y * r + 1.6666665459e-1f;
  y = y * r + 5.0000001201e-1f;
  y = y * (r * r) + r + 1.0f;
  const Int8 power = (n + 127) << 23;
  y *= reinterpret_cast<Float8>(power);
  x = is_large ? y : Float8{};
}

}  // namespace dhpmap
