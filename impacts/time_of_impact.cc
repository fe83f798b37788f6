#include "carom/impacts/time_of_impact.h"

#include <algorithm>
#include <array>
#include <memory>

#include "base/outward.h"
#include "base/parallel.h"
#include "impacts/first_times.h"
#include "impacts/impact_contacts.h"
#include "midphase/collide_pairs.h"
#include "narrowphase/batch/column_memory.h"

namespace carom {
namespace {

struct ImpactScratch {
  std::array<double, kPairsPerBlock> time;
  std::array<uint8_t, kPairsPerBlock> status;
  std::array<std::array<uint64_t, 2>, kPairsPerBlock> parts;
};

// One block of pairs.
class ImpactBlock {
 public:
  ImpactBlock(const MovingSide& a, const MovingSide& b, std::span<const Pair> pairs,
              const ImpactColumns& out, WitnessFrame frame, ImpactScratch& scratch)
      : a_(a), b_(b), pairs_(pairs), out_(out), frame_(frame), scratch_(scratch) {}

  void run() {
    find_first_times(a_, b_, pairs_, {},
                     {scratch_.time.data(), scratch_.status.data(), scratch_.parts.data()});
    write_times();
    write_parts(out_.sub_a, a_, 0);
    write_parts(out_.sub_b, b_, 1);
    if (!out_.want_contacts()) return;
    find_impact_contacts(a_, b_, pairs_.data(),
                         {scratch_.time.data(), scratch_.parts.data(), pairs_.size()}, frame_,
                         out_);
  }

 private:
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
    const BodyReader bodies{side.bodies};
    for (size_t row = 0; row < pairs_.size(); ++row) {
      const uint32_t body = of == 0 ? pairs_[row].a : pairs_[row].b;
      const bool meets = scratch_.time[row] <= 1;
      out[row] = meets ? sub_shape(bodies.kind(body), scratch_.parts[row][of]) : 0;
    }
  }

  const MovingSide &a_, &b_;
  const std::span<const Pair> pairs_;
  const ImpactColumns& out_;
  const WitnessFrame frame_;
  ImpactScratch& scratch_;
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
    static thread_local const auto scratch = std::make_unique_for_overwrite<ImpactScratch>();
    const ImpactColumns block_out = from_row(out, begin);
    ImpactBlock(side_a, side_b, pairs.subspan(begin, end - begin), block_out, options.frame,
                *scratch)
        .run();
  };
  for_each_block(pairs.size(), kPairsPerBlock, options.parallelism, run_block);
  return {};
}

}  // namespace carom
