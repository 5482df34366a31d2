// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "mapping/base/thread_pool.h"
#include "mapping/crf/grow_buffer.h"

namespace dhpmap {

/// 30 bits in which points near each other are near each other: the interleaved bits (Morton) of x, y and z, each given
/// as a fraction of the cloud's extent in [0, 1].
std::uint32_t MortonCode(const Eigen::Vector3f& fraction);

/// The indices of `codes` by ascending code; equal codes stay in their order. `codes` serves as working memory. Codes
/// must be below 2^30, and less than 2^32 of them.
void SortByCode(GrowBuffer<std::uint32_t>& codes, GrowBuffer<std::uint32_t>& order, ThreadPool& pool);

}  // namespace dhpmap
