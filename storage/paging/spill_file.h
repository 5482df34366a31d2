// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/paging/tile_page.h"
#include "mapping/paging/tile_spill.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

/// A file without a name, of the process alone: what is written is read again as it was, and gone with the process.
/// Room that was given back is used again, so that it is as large as the most that it ever held. Thread-safe.
class SpillFile {
 public:
  /// Of room for one piece each.
  static constexpr std::size_t kPageBytes = std::size_t{16} << 10;

  /// In a folder that can be written to.
  static Result<std::shared_ptr<SpillFile>> Open(const std::string& folder);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  /// The pages that hold the bytes, in their order. RESOURCE_EXHAUSTED if less than 256 MiB of the disk would stay
  /// free; then nothing is taken.
  Result<std::vector<std::uint32_t>> Write(ByteView bytes) DHPMAP_EXCLUDES(mutex_);
  /// As many bytes as were written. UNAVAILABLE if the disk fails.
  [[nodiscard]] Result<Bytes> Read(std::span<const std::uint32_t> pages, std::size_t num_bytes) const;
  void GiveBack(std::span<const std::uint32_t> pages) DHPMAP_EXCLUDES(mutex_);

  /// Of the file.
  [[nodiscard]] std::int64_t size_bytes() const DHPMAP_EXCLUDES(mutex_);

 private:
  explicit SpillFile(int file) : file_(file) {}
  Result<std::vector<std::uint32_t>> Take(std::size_t num_pages) DHPMAP_EXCLUDES(mutex_);

  const int file_;
  mutable Mutex mutex_;
  std::vector<std::uint32_t> free_ DHPMAP_GUARDED_BY(mutex_);
  std::uint32_t num_pages_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

/// Tiles in such a file.
class TileSpillFile final : public TileSpill {
 public:
  explicit TileSpillFile(std::shared_ptr<SpillFile> file) : file_(std::move(file)) {}
  Result<std::shared_ptr<TileSource>> Write(const BlockTile& tile) override;
  [[nodiscard]] std::int64_t size_bytes() const override { return file_->size_bytes(); }

 private:
  const std::shared_ptr<SpillFile> file_;
};

}  // namespace dhpmap
