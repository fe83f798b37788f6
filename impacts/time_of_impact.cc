#include "carom/impacts/time_of_impact.h"

#include <algorithm>
#include <array>
#include <memory>

#include "base/outward.h"
#include "base/parallel.h"
#include "impacts/composite_times.h"
#include "impacts/impact_contacts.h"
#include "midphase/collide_pairs.h"
#include "narrowphase/batch/column_memory.h"

namespace carom {
namespace {

struct ImpactScratch {
  std::array<double, kPairsPerBlock> time;
  std::array<uint8_t, kPairsPerBlock> status;
  std::array<std::array<uint64_t, 2>, kPairsPerBlock> parts;  // of rows with composites
  // Rows without and with composites, if a block may have both.
  std::array<uint16_t, kPairsPerBlock> simple, composite;
  std::array<Pair, kPairsPerBlock> simple_pairs;
  std::array<double, kPairsPerBlock> simple_time;
  std::array<uint8_t, kPairsPerBlock> simple_status;
  std::array<FirstTime, kPairsPerBlock> found;
};

bool may_have_parts(const Collidables& bodies) {
  return bodies.kind || is_composite(bodies.uniform_kind);
}

// One block of pairs.
class ImpactBlock {
 public:
  ImpactBlock(const MovingSide& a, const MovingSide& b, std::span<const Pair> pairs,
              const ImpactColumns& out, WitnessFrame frame, ImpactScratch& scratch)
      : a_(a), b_(b), pairs_(pairs), out_(out), frame_(frame), scratch_(scratch) {}

  void run() {
    if (may_have_parts(a_.bodies) || may_have_parts(b_.bodies)) {
      sort_out();
      find_sorted();
    } else {
      find_simple_times(a_, b_, pairs_.data(), pairs_.size(),
                        {scratch_.time.data(), scratch_.status.data()});
    }
    write_times();
    write_parts(out_.sub_a, a_, 0);
    write_parts(out_.sub_b, b_, 1);
    if (!out_.want_contacts()) return;
    find_impact_contacts(a_, b_, pairs_.data(),
                         {scratch_.time.data(), scratch_.parts.data(), pairs_.size()}, frame_,
                         out_);
  }

 private:
  bool has_parts(Pair pair) const {
    return is_composite(BodyReader{a_.bodies}.kind(pair.a)) ||
           is_composite(BodyReader{b_.bodies}.kind(pair.b));
  }

  void sort_out() {
    for (size_t row = 0; row < pairs_.size(); ++row) {
      if (has_parts(pairs_[row])) {
        scratch_.composite[composite_count_++] = static_cast<uint16_t>(row);
      } else {
        scratch_.simple_pairs[simple_count_] = pairs_[row];
        scratch_.simple[simple_count_++] = static_cast<uint16_t>(row);
      }
    }
  }

  void find_sorted() {
    find_simple_times(a_, b_, scratch_.simple_pairs.data(), simple_count_,
                      {scratch_.simple_time.data(), scratch_.simple_status.data()});
    for (size_t i = 0; i < simple_count_; ++i) {
      const size_t row = scratch_.simple[i];
      scratch_.time[row] = scratch_.simple_time[i];
      scratch_.status[row] = scratch_.simple_status[i];
    }
    if (composite_count_ == 0) return;
    const auto rows = std::span(scratch_.composite).first(composite_count_);
    find_composite_times(a_, b_, pairs_.data(), rows, std::span(scratch_.found));
    for (size_t i = 0; i < composite_count_; ++i) {
      const FirstTime& found = scratch_.found[i];
      scratch_.time[rows[i]] = found.time;
      scratch_.status[rows[i]] = static_cast<uint8_t>(found.status);
      scratch_.parts[rows[i]] = found.parts;
    }
  }

  void write_times() {
    if (out_.status) std::copy_n(scratch_.status.begin(), pairs_.size(), out_.status);
    if (!out_.toi) return;
    for (size_t row = 0; row < pairs_.size(); ++row) {
      const double time = scratch_.time[row];
      const auto as_float = static_cast<float>(time);  // may be infinite or NaN
      out_.toi[row] = time <= 1 ? round_downwards(time) : as_float;
    }
  }

  void write_parts(uint32_t* out, const MovingSide& side, size_t of) {
    if (!out) return;
    std::fill_n(out, pairs_.size(), 0);
    const BodyReader bodies{side.bodies};
    for (const uint16_t row : std::span(scratch_.composite).first(composite_count_)) {
      if (!(scratch_.time[row] <= 1)) continue;
      const Pair pair = pairs_[row];
      const size_t body = of == 0 ? pair.a : pair.b;
      out[row] = sub_shape(bodies.kind(body), scratch_.parts[row][of]);
    }
  }

  const MovingSide &a_, &b_;
  const std::span<const Pair> pairs_;
  const ImpactColumns& out_;
  const WitnessFrame frame_;
  ImpactScratch& scratch_;
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
                            const ImpactColumns& out, const ImpactOptions& options) {
  if (Result<void> checked = check_pairs(a, b, pairs); !checked) return checked;
  const MovingSide side_a{a, sweep_a}, side_b{b, sweep_b};
  const auto run_block = [&](size_t, size_t begin, size_t end) {
    static thread_local const auto scratch = std::make_unique<ImpactScratch>();
    const ImpactColumns block_out = from_row(out, begin);
    ImpactBlock(side_a, side_b, pairs.subspan(begin, end - begin), block_out, options.frame,
                *scratch)
        .run();
  };
  for_each_block(pairs.size(), kPairsPerBlock, options.parallelism, run_block);
  return {};
}

}  // namespace carom
