#include "carom/sweep/time_of_impact.h"

#include <array>
#include <memory>

#include "kernel/outward.h"
#include "kernel/parallel.h"
#include "midphase/collide_pairs.h"
#include "narrowphase/passes.h"
#include "sweep/composite_times.h"
#include "sweep/impact_contacts.h"

namespace carom {
namespace {

struct Scratch {
  std::array<double, kPairsPerBlock> time;
  std::array<uint8_t, kPairsPerBlock> status;
  std::array<Pair, kPairsPerBlock> pairs;
  std::array<uint16_t, kPairsPerBlock> simple, composite;  // rows
  std::array<FirstTime, kPairsPerBlock> first, found;
};

// A block of pairs.
class ImpactBlock {
 public:
  ImpactBlock(const MovingSide& a, const MovingSide& b, std::span<const Pair> pairs,
              const ImpactColumns& out, WitnessFrame frame, Scratch& scratch)
      : a_(a), b_(b), pairs_(pairs), out_(out), frame_(frame), scratch_(scratch) {}

  void run() {
    sort_out();
    find_simple();
    find_composites();
    const auto first = std::span(scratch_.first).first(pairs_.size());
    for (size_t row = 0; row < pairs_.size(); ++row) write(row, first[row]);
    if (out_.want_contacts()) find_impact_contacts(a_, b_, pairs_.data(), first, frame_, out_);
  }

 private:
  void sort_out() {
    const BodyReader a{a_.bodies}, b{b_.bodies};
    for (size_t row = 0; row < pairs_.size(); ++row) {
      const Pair pair = pairs_[row];
      const bool has_parts = is_composite(a.kind(pair.a)) || is_composite(b.kind(pair.b));
      if (has_parts) {
        scratch_.composite[composite_count_++] = static_cast<uint16_t>(row);
      } else {
        scratch_.pairs[simple_count_] = pair;
        scratch_.simple[simple_count_++] = static_cast<uint16_t>(row);
      }
    }
  }

  void find_simple() {
    find_simple_times(a_, b_, scratch_.pairs.data(), simple_count_,
                      {scratch_.time.data(), scratch_.status.data()});
    for (size_t i = 0; i < simple_count_; ++i) {
      scratch_.first[scratch_.simple[i]] = {scratch_.time[i],
                                            static_cast<Status>(scratch_.status[i])};
    }
  }

  void find_composites() {
    if (composite_count_ == 0) return;
    const auto rows = std::span(scratch_.composite).first(composite_count_);
    find_composite_times(a_, b_, pairs_.data(), rows, std::span(scratch_.found));
    for (size_t i = 0; i < rows.size(); ++i) scratch_.first[rows[i]] = scratch_.found[i];
  }

  void write(size_t row, const FirstTime& first) {
    const bool meets = first.time <= 1;
    const auto as_float = static_cast<float>(first.time);  // infinite, or not a number
    if (out_.toi) out_.toi[row] = meets ? round_downwards(first.time) : as_float;
    if (out_.status) out_.status[row] = static_cast<uint8_t>(first.status);
    const Pair pair = pairs_[row];
    if (out_.sub_a) {
      out_.sub_a[row] = meets ? sub_shape(BodyReader{a_.bodies}.kind(pair.a), first.parts[0]) : 0;
    }
    if (out_.sub_b) {
      out_.sub_b[row] = meets ? sub_shape(BodyReader{b_.bodies}.kind(pair.b), first.parts[1]) : 0;
    }
  }

  const MovingSide &a_, &b_;
  const std::span<const Pair> pairs_;
  const ImpactColumns& out_;
  const WitnessFrame frame_;
  Scratch& scratch_;
  size_t simple_count_ = 0, composite_count_ = 0;
};

ImpactColumns from_row(const ImpactColumns& columns, size_t row) {
  ImpactColumns result = columns;
  const auto advance = [row](auto*& column) { column = column ? column + row : nullptr; };
  advance(result.toi);
  advance(result.status);
  advance(result.separation);
  for (auto* vector : {&result.normal, &result.point_a, &result.point_b}) {
    for (float*& column : *vector) advance(column);
  }
  advance(result.sub_a);
  advance(result.sub_b);
  return result;
}

}  // namespace

Result<void> time_of_impact(const Collidables& a, const SweepView& sweep_a, const Collidables& b,
                            const SweepView& sweep_b, std::span<const Pair> pairs,
                            const ImpactColumns& out, WitnessFrame frame, Parallelism parallelism) {
  if (Result<void> checked = check_pairs(a, b, pairs); !checked) return checked;
  const MovingSide side_a{a, sweep_a}, side_b{b, sweep_b};
  for_each_block(pairs.size(), kPairsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    static thread_local const auto scratch = std::make_unique<Scratch>();
    const ImpactColumns block_out = from_row(out, begin);
    ImpactBlock(side_a, side_b, pairs.subspan(begin, end - begin), block_out, frame, *scratch)
        .run();
  });
  return {};
}

}  // namespace carom
