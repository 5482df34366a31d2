// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace dhpmap {

/// CRC-32C (Castagnoli polynomial) of `bytes`, continuing from `crc`, the checksum of preceding bytes (0 at the start).
std::uint32_t Crc32c(std::span<const std::uint8_t> bytes, std::uint32_t crc = 0);
/// The same without CPU support, at a fifth of the speed; for tests.
std::uint32_t Crc32cByTables(std::span<const std::uint8_t> bytes, std::uint32_t crc = 0);

}  // namespace dhpmap
