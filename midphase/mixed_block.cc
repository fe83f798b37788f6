#include "midphase/mixed_block.h"

#include <array>
#include <memory>
#include <span>

#include "midphase/composite_block.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

// The rows of simple pairs, which run as a block of their own, and the rows of all others.
struct MixedScratch {
  size_t simple_count = 0, composite_count = 0;
  std::array<uint16_t, kPairsPerBlock> simple, composite;
  std::array<Pair, kPairsPerBlock> pairs;
  std::array<uint32_t, kPairsPerBlock> direction;
  std::array<float, kPairsPerBlock> reach;
  BlockColumns memory;

  std::span<const uint16_t> simple_rows() const { return std::span(simple).first(simple_count); }
  std::span<const uint16_t> composite_rows() const {
    return std::span(composite).first(composite_count);
  }
};

Pair pair_at(const PairBlock& block, size_t row) {
  if (block.pairs) return block.pairs[row];
  const auto index = static_cast<uint32_t>(block.first + row);
  return {index, index};
}

void sort_out(const PairBlock& block, MixedScratch& scratch) {
  const BodyReader a{block.a}, b{block.b};
  scratch.simple_count = scratch.composite_count = 0;
  for (size_t row = 0; row < block.count; ++row) {
    const Pair pair = pair_at(block, row);
    if (is_composite(a.kind(pair.a)) || is_composite(b.kind(pair.b))) {
      scratch.composite[scratch.composite_count++] = static_cast<uint16_t>(row);
    } else {
      scratch.pairs[scratch.simple_count] = pair;
      scratch.simple[scratch.simple_count++] = static_cast<uint16_t>(row);
    }
  }
}

void run_simple_pairs(const PairBlock& block, MixedScratch& scratch) {
  const std::span<const uint16_t> rows = scratch.simple_rows();
  const ResultColumns out = as_asked(scratch.memory.columns(), block.out);
  for (size_t i = 0; out.features && i < rows.size(); ++i) {
    out.features[i] = block.out.features[rows[i]];
  }
  PairBlock simple = {.a = block.a,
                      .b = block.b,
                      .pairs = scratch.pairs.data(),
                      .first = 0,
                      .count = rows.size(),
                      .detail = block.detail,
                      .frame = block.frame,
                      .measured = block.measured,
                      .accuracy = block.accuracy,
                      .out = out};
  uint32_t* const directions = block.memory.direction;
  if (directions) {
    for (size_t i = 0; i < rows.size(); ++i) scratch.direction[i] = directions[rows[i]];
    simple.memory = {scratch.direction.data(), block.memory.shells};
  }
  if (block.reach) {
    for (size_t i = 0; i < rows.size(); ++i) scratch.reach[i] = block.reach[rows[i]];
    simple.reach = scratch.reach.data();
  }
  run_pair_block(simple);
  copy_rows(out, block.out, block.detail, rows.size(), [rows](size_t i) { return rows[i]; });
  for (size_t i = 0; directions && i < rows.size(); ++i) {
    directions[rows[i]] = scratch.direction[i];
  }
}

}  // namespace

void run_mixed_block(const PairBlock& block, const ExtraRequest& extra) {
  static thread_local const auto scratch = std::make_unique_for_overwrite<MixedScratch>();
  sort_out(block, *scratch);
  if (scratch->composite_count == 0) return run_pair_block(block);
  if (scratch->simple_count > 0) run_simple_pairs(block, *scratch);
  run_composite_pairs(block, scratch->composite_rows(), extra);
  // Such pairs remember nothing, whatever their bodies were in the last step.
  uint32_t* const directions = block.memory.direction;
  for (size_t i = 0; directions && i < scratch->composite_count; ++i) {
    directions[scratch->composite[i]] = kNoDirection;
  }
}

}  // namespace carom
