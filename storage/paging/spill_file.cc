// SPDX-License-Identifier: BSD-3-Clause
#include "storage/paging/spill_file.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "mapping/paging/tile_page.h"
#include "storage/codec/crc32c.h"
#include "storage/store.h"
#include "storage/tiles/object_layers.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

Status OfDisk(const std::string& task) {
  const std::string message = task + ": " + std::strerror(errno);
  if (errno == ENOSPC || errno == EDQUOT) return ResourceExhausted(message);
  return Unavailable(message);
}

/// The database on the same disk needs space, too.
Status CheckRoomForPages(int file, std::size_t num_bytes) {
  constexpr std::uint64_t kLeftFreeForPages_bytes = 256u << 20;
  struct statvfs disk {};
  if (fstatvfs(file, &disk) != 0) return Status::Ok();  // then writing reports it
  if (std::uint64_t{disk.f_bavail} * disk.f_frsize >= num_bytes + kLeftFreeForPages_bytes) return Status::Ok();
  return ResourceExhausted("what has no room in memory would leave too little of the disk");
}

/// For file systems without unnamed files: creates a file and unlinks it at once.
int OpenAndForget(const std::string& folder) {
  std::string name = folder + "/dhpmap-spill-XXXXXX";
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) unlink(name.c_str());
  return file;
}

// A tile in the file: its cells with geometry; for each cell distances, weights and colours of all voxels, bit-exact;
// then the blobs of the other layers in the form of stores, each preceded by its length; finally a checksum.

template <typename Plane>
ByteView FileBytesOf(const Plane& plane) {
  return {reinterpret_cast<const std::uint8_t*>(plane.data()), sizeof(plane)};
}
template <typename Plane>
std::span<std::uint8_t> MutableBytesOf(Plane& plane) {
  return {reinterpret_cast<std::uint8_t*>(plane.data()), sizeof(plane)};
}

Bytes Flatten(const BlockTile& tile) {
  const TileIndex index = TileOf(tile.entries().front().index);
  Bytes bytes;
  bytes.reserve(tile.entries().size() * sizeof(TsdfBlock) * 5 / 4);
  ByteWriter writer(bytes);
  writer.PutU64(tile.CellsWith(BlockLayer::kTsdf));
  for (const BlockEntry& entry : tile.entries()) {
    if (entry.tsdf == nullptr) continue;
    writer.PutBytes(FileBytesOf(entry.tsdf->distance_m));
    writer.PutBytes(FileBytesOf(entry.tsdf->weight));
    writer.PutBytes(FileBytesOf(entry.tsdf->color));
  }
  for (const ObjectLayer& layer : ObjectLayers()) {
    if (layer.layer == BlockLayer::kTsdf) continue;
    const bool has_any = tile.CellsWith(layer.layer) != 0;
    const Bytes blob = has_any ? layer.encode(tile, index, SubmapInfo()) : Bytes();
    writer.PutVarint(blob.size());
    writer.PutBytes(blob);
  }
  writer.PutU32(Crc32c(bytes));
  return bytes;
}

Status Unflatten(ByteView bytes, TileIndex index, BlockTile& tile) {
  constexpr std::size_t kPageChecksumBytes = 4;
  if (bytes.size() < kPageChecksumBytes) return DataLoss("is cut short");
  const ByteView content = bytes.first(bytes.size() - kPageChecksumBytes);
  ByteReader checksum(bytes.last(kPageChecksumBytes));
  if (checksum.GetU32() != Crc32c(content)) return DataLoss("has a wrong checksum");
  ByteReader reader(content);
  const std::uint64_t cells = reader.GetU64();
  for (int cell = 0; cell < kTileBlocks; ++cell) {
    if ((cells >> cell & 1u) == 0) continue;
    auto block = std::shared_ptr<TsdfBlock>(new TsdfBlock());  // not make_shared: StateMarks would keep its memory
    reader.GetInto(MutableBytesOf(block->distance_m));
    reader.GetInto(MutableBytesOf(block->weight));
    reader.GetInto(MutableBytesOf(block->color));
    tile.FindOrInsert(BlockIn(index, cell)).tsdf = std::move(block);
  }
  for (const ObjectLayer& layer : ObjectLayers()) {
    if (layer.layer == BlockLayer::kTsdf) continue;
    const ByteView blob = reader.GetBytes(reader.GetVarint());
    if (!blob.empty()) DHPMAP_RETURN_IF_ERROR(layer.decode(blob, index, tile));
  }
  return reader.ok() ? Status::Ok() : DataLoss("is cut short");
}

/// A tile in a spill file.
class SpilledTile final : public TileSource {
 public:
  explicit SpilledTile(std::shared_ptr<SpillFile> file) : file_(std::move(file)) {}
  ~SpilledTile() override { file_->GiveBack(pages_); }
  SpilledTile(const SpilledTile&) = delete;
  SpilledTile& operator=(const SpilledTile&) = delete;

  Status Write(ByteView bytes) {
    DHPMAP_ASSIGN_OR_RETURN(pages_, file_->Write(bytes));
    num_bytes_ = bytes.size();
    return Status::Ok();
  }

  Result<std::vector<BlockEntry>> Read(const TileOnDisk& there) override {
    const Result<Bytes> bytes = file_->Read(pages_, num_bytes_);
    BlockTile tile;
    const Status read = bytes.ok() ? Unflatten(*bytes, there.index, tile) : bytes.status();
    if (!read.ok()) return Status(read.code(), NameOfTile("spilled", there.index) + " " + read.message());
    return std::vector<BlockEntry>(tile.entries().begin(), tile.entries().end());
  }

 private:
  const std::shared_ptr<SpillFile> file_;
  std::vector<std::uint32_t> pages_;
  std::size_t num_bytes_ = 0;
};

/// Calls move(at, offset, num_bytes) for each page until all bytes are moved; `move` returns the number of bytes, like
/// read and write.
template <typename Move>
bool ForEachPage(std::span<const std::uint32_t> pages, std::size_t num_bytes, Move&& move) {
  for (std::size_t done = 0; done < num_bytes;) {
    const std::size_t in_page = done % SpillFile::kPageBytes;
    const std::size_t num = std::min(SpillFile::kPageBytes - in_page, num_bytes - done);
    const auto offset =
        static_cast<off_t>(pages[done / SpillFile::kPageBytes]) * static_cast<off_t>(SpillFile::kPageBytes) +
        static_cast<off_t>(in_page);
    const ssize_t moved = move(done, offset, num);
    if (moved < 0 && errno == EINTR) continue;
    if (moved == 0) errno = EIO;
    if (moved <= 0) return false;
    done += static_cast<std::size_t>(moved);
  }
  return true;
}

}  // namespace

Result<std::shared_ptr<SpillFile>> SpillFile::Open(const std::string& folder) {
  int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file < 0) file = OpenAndForget(folder);
  if (file < 0) return OfDisk("make a file for what has no room in memory");
  return std::shared_ptr<SpillFile>(new SpillFile(file));
}

SpillFile::~SpillFile() { close(file_); }

Result<std::vector<std::uint32_t>> SpillFile::Take(std::size_t num_pages) {
  std::vector<std::uint32_t> pages;
  pages.reserve(num_pages);
  const MutexLock lock(mutex_);
  if (num_pages > free_.size()) {
    DHPMAP_RETURN_IF_ERROR(CheckRoomForPages(file_, num_pages * kPageBytes));
    const std::size_t num_then = num_pages_ + num_pages;  // first: returning pages must not fail, and none may be lost
    if (free_.capacity() < num_then) free_.reserve(2 * num_then);
  }
  for (; pages.size() < num_pages && !free_.empty(); free_.pop_back()) pages.push_back(free_.back());
  while (pages.size() < num_pages) pages.push_back(num_pages_++);
  return pages;
}

Result<std::vector<std::uint32_t>> SpillFile::Write(ByteView bytes) {
  DHPMAP_ASSIGN_OR_RETURN(std::vector<std::uint32_t> pages, Take((bytes.size() + kPageBytes - 1) / kPageBytes));
  const bool written = ForEachPage(pages, bytes.size(), [&](std::size_t at, off_t offset, std::size_t num) {
    return pwrite(file_, bytes.data() + at, num, offset);
  });
  if (written) return pages;
  Status failed = OfDisk("write what has no room in memory");
  GiveBack(pages);
  return failed;
}

Result<Bytes> SpillFile::Read(std::span<const std::uint32_t> pages, std::size_t num_bytes) const {
  Bytes bytes(num_bytes);
  const bool read = ForEachPage(pages, num_bytes, [&](std::size_t at, off_t offset, std::size_t num) {
    return pread(file_, bytes.data() + at, num, offset);
  });
  if (!read) return OfDisk("cannot be read");
  return bytes;
}

void SpillFile::GiveBack(std::span<const std::uint32_t> pages) {
  const MutexLock lock(mutex_);
  free_.insert(free_.end(), pages.begin(), pages.end());
  if (free_.size() < num_pages_) return;
  free_.clear();  // the file is empty: return its space to the disk
  if (ftruncate(file_, 0) == 0) num_pages_ = 0;
  for (std::uint32_t page = num_pages_; page > 0; --page) free_.push_back(page - 1);
}

std::int64_t SpillFile::size_bytes() const {
  const MutexLock lock(mutex_);
  return std::int64_t{num_pages_} * static_cast<std::int64_t>(kPageBytes);
}

Result<std::shared_ptr<TileSource>> TileSpillFile::Write(const BlockTile& tile) {
  const Bytes bytes = Flatten(tile);
  auto there = std::make_shared<SpilledTile>(file_);
  DHPMAP_RETURN_IF_ERROR(there->Write(bytes));
  return std::shared_ptr<TileSource>(std::move(there));
}

Result<std::shared_ptr<TileSpill>> OpenTileSpill(const std::string& folder) {
  DHPMAP_ASSIGN_OR_RETURN(auto file, SpillFile::Open(folder));
  return std::shared_ptr<TileSpill>(std::make_shared<TileSpillFile>(std::move(file)));
}

}  // namespace dhpmap
