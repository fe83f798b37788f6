#include "world/pairs/gap_stage.h"

#include <algorithm>

#include "midphase/collide_pairs.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

// The search for parts takes longer the further it goes.
constexpr float kSteps = 400, kStepsOfComposites = 16;

}  // namespace

void GapStage::measure(std::span<const Pair> pairs, const PairRange& range,
                       const ResultBuffer& results, const Collidables& bodies,
                       const ContactDistances& distances, const Drift& drift,
                       Parallelism parallelism) {
  const BodyReader reader{bodies};
  first_row_ = range.first_row;
  gap_.assign(range.rows, 0);
  pairs_.clear();
  rows_.clear();
  reach_.clear();
  bool any_composite = false;
  for (size_t k = 0; k < range.rows; ++k) {
    const size_t row = range.first_row + k;
    if (results.overlap(row) != 0 || results.is_near(row)) continue;
    const Pair pair = pairs[row];
    const ShapeKind a = reader.kind(pair.a), b = reader.kind(pair.b);
    if (is_surface(a) && is_surface(b)) continue;
    const bool has_parts = is_composite(a) || is_composite(b);
    any_composite |= has_parts;
    pairs_.push_back(pair);
    rows_.push_back(static_cast<uint32_t>(k));
    reach_.push_back(distances.of(pair) +
                     drift.reach(pair, has_parts ? kStepsOfComposites : kSteps));
  }
  if (pairs_.empty()) return;
  constexpr ColumnRole kSubShape[] = {ColumnRole::sub_shape};
  columns_.resize(pairs_.size(), Detail::contact,
                  std::span(kSubShape).first(any_composite ? 1 : 0));
  const CollideOptions options = {.frame = WitnessFrame::body,
                                  .parallelism = parallelism,
                                  .measured = Measured::overlapping,
                                  .contact_distances = reach_.data()};
  collide_pairs({bodies, pairs_, any_composite, nullptr, nullptr}, Detail::contact,
                columns_.columns(), options);
  for (size_t i = 0; i < pairs_.size(); ++i) {
    const ResultColumns& found = columns_.columns();
    // Pairs that are further apart were not measured.
    const float separation = found.overlap[i] ? 0 : std::min(found.separation[i], reach_[i]);
    gap_[rows_[i]] = separation - distances.of(pairs_[i]);
  }
}

}  // namespace carom
