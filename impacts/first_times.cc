#include "impacts/first_times.h"

#include <algorithm>
#include <memory>

#include "impacts/composite_times.h"
#include "narrowphase/batch/column_memory.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

// Rows without and with composites, if a block may have both.
struct SortedRows {
  std::array<uint16_t, kPairsPerBlock> simple, composite;
  std::array<Pair, kPairsPerBlock> simple_pairs;
  std::array<double, kPairsPerBlock> simple_time;
  std::array<uint8_t, kPairsPerBlock> simple_status;
  std::array<FirstTime, kPairsPerBlock> found;
};

bool may_have_parts(const Collidables& bodies) {
  return bodies.kind || is_composite(bodies.uniform_kind);
}

}  // namespace

void find_first_times(const MovingSide& a, const MovingSide& b, std::span<const Pair> pairs,
                      const TimesWanted& wanted, const FirstTimeColumns& out) {
  std::fill_n(out.parts, pairs.size(), std::array<uint64_t, 2>{});
  if (!may_have_parts(a.bodies) && !may_have_parts(b.bodies)) {
    return find_simple_times(a, b, pairs.data(), pairs.size(), {out.time, out.status});
  }
  static thread_local const auto sorted = std::make_unique_for_overwrite<SortedRows>();
  SortedRows& rows = *sorted;
  const BodyReader reader_a{a.bodies}, reader_b{b.bodies};
  size_t simple = 0, composite = 0;
  for (size_t row = 0; row < pairs.size(); ++row) {
    const Pair pair = pairs[row];
    if (is_composite(reader_a.kind(pair.a)) || is_composite(reader_b.kind(pair.b))) {
      rows.composite[composite++] = static_cast<uint16_t>(row);
    } else {
      rows.simple_pairs[simple] = pair;
      rows.simple[simple++] = static_cast<uint16_t>(row);
    }
  }
  find_simple_times(a, b, rows.simple_pairs.data(), simple,
                    {rows.simple_time.data(), rows.simple_status.data()});
  for (size_t i = 0; i < simple; ++i) {
    out.time[rows.simple[i]] = rows.simple_time[i];
    out.status[rows.simple[i]] = rows.simple_status[i];
  }
  if (composite == 0) return;
  const auto composites = std::span<const uint16_t>(rows.composite).first(composite);
  find_composite_times(a, b, pairs.data(), composites, wanted, std::span(rows.found));
  for (size_t i = 0; i < composite; ++i) {
    out.time[composites[i]] = rows.found[i].time;
    out.status[composites[i]] = static_cast<uint8_t>(rows.found[i].status);
    out.parts[composites[i]] = rows.found[i].parts;
  }
}

}  // namespace carom
