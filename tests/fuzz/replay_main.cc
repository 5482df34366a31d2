// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzz target as an ordinary test, or writes its seeds for libFuzzer:
//   NAME_replay [FOLDER]              seeds, spoiled seeds, files of FOLDER
//   NAME_replay --write-seeds FOLDER
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "tests/fuzz/fuzz_target.h"

namespace dhpmap::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int kSpoiledPerSeed = 400;

void Run(const std::string& input) {
  // A copy of exactly this size, so that AddressSanitizer sees a read past the end.
  const std::vector<std::uint8_t> bytes(input.begin(), input.end());
  Require(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()) == 0);
}

/// The same for every run: the generator's output is fixed by the standard.
std::string Spoil(std::string input, std::mt19937& random) {
  const auto at = [&] { return input.empty() ? 0 : random() % input.size(); };
  for (auto times = 1 + random() % 3; times > 0; --times) {
    switch (random() % 6) {
      case 0:
        if (!input.empty()) input[at()] = static_cast<char>(random());
        break;
      case 1:
        if (!input.empty()) input[at()] ^= static_cast<char>(1u << random() % 8);
        break;
      case 2: input.resize(at()); break;
      case 3: input.insert(at(), 1 + random() % 9, static_cast<char>(random())); break;
      case 4: input.erase(at(), 1 + random() % 9); break;
      default: input.insert(at(), input.substr(at(), random() % 40)); break;
    }
  }
  return input;
}

int WriteSeeds(const fs::path& folder) {
  fs::create_directories(folder);
  int number = 0;
  for (const std::string& seed : Seeds()) {
    std::ofstream(folder / ("seed-" + std::to_string(number++)), std::ios::binary) << seed;
  }
  return number > 0 ? 0 : 1;
}

int Replay(const char* corpus) {
  int num_runs = 0;
  std::mt19937 random(1);
  Run("");
  for (const std::string& seed : Seeds()) {
    Run(seed);
    for (int i = 0; i < kSpoiledPerSeed; ++i, ++num_runs) Run(Spoil(seed, random));
  }
  if (corpus != nullptr && fs::is_directory(corpus)) {
    for (const auto& entry : fs::directory_iterator(corpus)) {
      std::ifstream in(entry.path(), std::ios::binary);
      Run({std::istreambuf_iterator<char>(in), {}});
      ++num_runs;
    }
  }
  std::printf("%d inputs\n", num_runs);
  return num_runs > 0 ? 0 : 1;
}

}  // namespace
}  // namespace dhpmap::fuzz

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--write-seeds") == 0) return dhpmap::fuzz::WriteSeeds(argv[2]);
  return dhpmap::fuzz::Replay(argc > 1 ? argv[1] : nullptr);
}
