// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/label_channels.h"

#include <algorithm>
#include <numeric>

namespace dhpmap {
namespace {

/// Rows of bits.
class BitRows {
 public:
  BitRows(std::size_t num_rows, std::size_t num_bits) : words_((num_bits + 63) / 64), bits_(num_rows * words_, 0) {}
  [[nodiscard]] std::span<std::uint64_t> Row(std::size_t row) { return {bits_.data() + row * words_, words_}; }
  void Set(std::size_t row, std::size_t bit) { Row(row)[bit / 64] |= std::uint64_t{1} << (bit % 64); }
  [[nodiscard]] bool IsSet(std::size_t row, std::size_t bit) { return (Row(row)[bit / 64] >> (bit % 64) & 1u) != 0; }
  void AddRow(std::size_t row, std::span<const std::uint64_t> other) {
    for (std::size_t w = 0; w < words_; ++w) Row(row)[w] |= other[w];
  }

 private:
  std::size_t words_;
  ScratchVector<std::uint64_t> bits_;
};

}  // namespace

std::size_t LabelChannels::NumberOf(std::uint32_t label) const {
  return static_cast<std::size_t>(std::lower_bound(labels_.begin(), labels_.end(), label) - labels_.begin());
}

void LabelChannels::Assign(std::span<const std::vector<std::uint32_t>> neighbours) {
  for (const auto& [place, label] : seen_) labels_.push_back(label);
  std::sort(labels_.begin(), labels_.end());
  labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
  const std::size_t num_labels = labels_.size();

  BitRows here(num_places_, num_labels), near(num_places_, num_labels), rivals(num_labels, num_labels);
  for (const auto& [place, label] : seen_) here.Set(place, NumberOf(label));
  std::vector<std::size_t> num_near(num_labels, 0);
  for (std::size_t p = 0; p < num_places_; ++p) {
    for (const std::uint32_t n : neighbours[p]) near.AddRow(p, here.Row(n));
    for (std::size_t l = 0; l < num_labels; ++l) {
      if (!near.IsSet(p, l)) continue;
      ++num_near[l];
      rivals.AddRow(l, near.Row(p));
    }
  }

  std::vector<std::size_t> order(num_labels);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return num_near[a] > num_near[b]; });
  channel_.assign(num_labels, kNone);
  for (const std::size_t l : order) {
    std::vector<bool> is_taken(num_labels, false);
    for (std::size_t other = 0; other < num_labels; ++other) {
      if (channel_[other] != kNone && rivals.IsSet(l, other)) is_taken[channel_[other]] = true;
    }
    channel_[l] = static_cast<std::uint32_t>(std::find(is_taken.begin(), is_taken.end(), false) - is_taken.begin());
    num_channels_ = std::max(num_channels_, static_cast<int>(channel_[l]) + 1);
  }

  const auto stride = static_cast<std::size_t>(num_channels_);
  label_at_.assign(num_places_ * stride, kNone);
  for (std::size_t p = 0; p < num_places_; ++p) {
    for (std::size_t l = 0; l < num_labels; ++l) {
      if (near.IsSet(p, l)) label_at_[p * stride + channel_[l]] = labels_[l];
    }
  }
}

}  // namespace dhpmap
