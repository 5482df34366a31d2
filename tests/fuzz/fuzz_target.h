// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// A fuzz target is one file NAME_fuzz.cc that defines these two functions. In the preset `fuzz` libFuzzer calls the
// first; in every build a test calls it with the seeds, with the same seeds spoiled in many ways, and with what is in
// corpus/NAME (inputs that once showed a fault). It must return, whatever the bytes are.

/// Feeds the bytes to what is under test, and aborts where the outcome contradicts its contract. Returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace dhpmap::fuzz {

/// Good inputs to begin with.
std::vector<std::string> Seeds();

/// Aborts, which libFuzzer and the test both report, unless the contract holds.
inline void Require(bool holds) {
  if (!holds) __builtin_trap();
}

}  // namespace dhpmap::fuzz
