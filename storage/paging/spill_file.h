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

/// An unlinked file of this process for data that comes back unchanged and need not survive. Freed pages are reused, so
/// its size is the peak of its content. Thread-safe.
class SpillFile {
 public:
  /// Page size; a piece occupies whole pages.
  static constexpr std::size_t kPageBytes = std::size_t{16} << 10;

  /// In a writable folder.
  static Result<std::shared_ptr<SpillFile>> Open(const std::string& folder);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  /// The pages that hold the bytes, in order. RESOURCE_EXHAUSTED, with nothing written, if less than 256 MiB of the
  /// disk would stay free.
  Result<std::vector<std::uint32_t>> Write(ByteView bytes) DHPMAP_EXCLUDES(mutex_);
  /// `size` bytes as written. UNAVAILABLE if the disk fails.
  [[nodiscard]] Result<Bytes> Read(std::span<const std::uint32_t> pages, std::size_t num_bytes) const;
  void GiveBack(std::span<const std::uint32_t> pages) DHPMAP_EXCLUDES(mutex_);

  /// Size of the file.
  [[nodiscard]] std::int64_t size_bytes() const DHPMAP_EXCLUDES(mutex_);

 private:
  explicit SpillFile(int file) : file_(file) {}
  Result<std::vector<std::uint32_t>> Take(std::size_t num_pages) DHPMAP_EXCLUDES(mutex_);

  const int file_;
  mutable Mutex mutex_;
  std::vector<std::uint32_t> free_ DHPMAP_GUARDED_BY(mutex_);
  std::uint32_t num_pages_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

/// A TileSpill in such a file.
class TileSpillFile final : public TileSpill {
 public:
  explicit TileSpillFile(std::shared_ptr<SpillFile> file) : file_(std::move(file)) {}
  Result<std::shared_ptr<TileSource>> Write(const BlockTile& tile) override;
  [[nodiscard]] std::int64_t size_bytes() const override { return file_->size_bytes(); }

 private:
  const std::shared_ptr<SpillFile> file_;
};

}  // namespace dhpmap
