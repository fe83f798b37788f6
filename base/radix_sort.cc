#include "base/radix_sort.h"

namespace carom {
namespace {

constexpr size_t kItemsPerBlock = 1 << 16;
constexpr int kDigitBits = 11;
constexpr size_t kDigits = size_t{1} << kDigitBits;
constexpr int kKeyShift = 32;

size_t digit(uint64_t item, int shift) { return (item >> shift) & (kDigits - 1); }

// Turns the count of each block and digit into the place of that block's first item with that
// digit.
void counts_to_offsets(std::vector<uint32_t>& histograms, size_t blocks) {
  uint32_t offset = 0;
  for (size_t d = 0; d < kDigits; ++d) {
    for (size_t block = 0; block < blocks; ++block) {
      uint32_t& entry = histograms[block * kDigits + d];
      const uint32_t count = entry;
      entry = offset;
      offset += count;
    }
  }
}

void sort_by_digit(const std::vector<uint64_t>& from, std::vector<uint64_t>& to,
                   std::vector<uint32_t>& histograms, int shift, Parallelism parallelism) {
  const size_t blocks = block_count(from.size(), kItemsPerBlock);
  histograms.assign(blocks * kDigits, 0);
  for_each_block(from.size(), kItemsPerBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   uint32_t* counts = histograms.data() + block * kDigits;
                   for (size_t i = begin; i < end; ++i) ++counts[digit(from[i], shift)];
                 });
  counts_to_offsets(histograms, blocks);
  for_each_block(from.size(), kItemsPerBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   uint32_t* offsets = histograms.data() + block * kDigits;
                   for (size_t i = begin; i < end; ++i) {
                     to[offsets[digit(from[i], shift)]++] = from[i];
                   }
                 });
}

}  // namespace

void radix_sort_by_key(std::vector<uint64_t>& items, std::vector<uint64_t>& scratch,
                       std::vector<uint32_t>& histograms, Parallelism parallelism) {
  scratch.resize(items.size());
  for (int shift = kKeyShift; shift < 64; shift += kDigitBits) {
    sort_by_digit(items, scratch, histograms, shift, parallelism);
    items.swap(scratch);
  }
}

}  // namespace carom
