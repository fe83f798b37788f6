#include "carom/queries/cast.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "base/float_environment.h"
#include "carom/impacts/time_of_impact.h"
#include "queries/query_rounds.h"
#include "queries/searches.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

// The first round tests few candidates, because the hit is mostly among the first.
constexpr RoundSizes kForClosest = {.first = 2, .most = 8};
constexpr RoundSizes kForAll = {.first = 64, .most = 64};

// Results of time_of_impact(), one row per candidate.
struct Impacts {
  std::vector<float> toi, separation;
  std::vector<uint8_t> status;
  std::array<std::vector<float>, 3> normal, point;
  std::vector<uint32_t> sub_shape;

  void resize(size_t count) {
    toi.resize(count);
    separation.resize(count);
    status.resize(count);
    sub_shape.resize(count);
    for (size_t axis = 0; axis < 3; ++axis) {
      normal[axis].resize(count);
      point[axis].resize(count);
    }
  }

  ImpactColumns columns() {
    return {.toi = toi.data(),
            .status = status.data(),
            .separation = separation.data(),
            .normal = {normal[0].data(), normal[1].data(), normal[2].data()},
            .point_b = {point[0].data(), point[1].data(), point[2].data()},
            .sub_b = sub_shape.data()};
  }

  CastHit hit(Pair pair, size_t row) const {
    return {.query = pair.a,
            .body = pair.b,
            .sub_shape = sub_shape[row],
            .toi = toi[row],
            .normal = {normal[0][row], normal[1][row], normal[2][row]},
            .point = {point[0][row], point[1][row], point[2][row]},
            .separation = separation[row],
            .status = static_cast<Status>(status[row])};
  }
};

bool is_hit(float toi) { return toi <= 1; }

class Caster {
 public:
  Caster(const Collidables& queries, const SweepView& sweep, const SearchedBodies& bodies,
         std::vector<CastHit>& hits, Parallelism parallelism)
      : sweep_(sweep),
        bodies_(bodies),
        boxes_(queries, sweep, parallelism),
        hits_(hits),
        parallelism_(parallelism) {}

  Result<void> run(CastHits which) {
    for (size_t first = 0; first < boxes_.count(); first += kQueriesAtOnce) {
      const size_t count = std::min(kQueriesAtOnce, boxes_.count() - first);
      Result<void> done =
          which == CastHits::all ? find_all(first, count) : find_closest(first, count);
      if (!done) {
        hits_.clear();
        return done;
      }
    }
    return {};
  }

 private:
  Result<void> find_all(size_t first, size_t count) {
    const std::vector<float> limit(count, 1.0f);
    const size_t before = hits_.size();
    const auto test = [&](std::span<const Pair> candidates) { return add_hits(candidates); };
    Result<void> found = search_in_rounds(boxes_, bodies_, SearchFor::met, kForAll, first, limit,
                                          parallelism_, test);
    std::sort(hits_.begin() + static_cast<ptrdiff_t>(before), hits_.end(),
              [](const CastHit& a, const CastHit& b) {
                return std::tie(a.query, a.toi, a.body) < std::tie(b.query, b.toi, b.body);
              });
    return found;
  }

  // Finds the times of all candidates, then the contacts of the first hits.
  Result<void> find_closest(size_t first, size_t count) {
    std::vector<float> limit(count, 1.0f);
    std::vector<uint32_t> best(count, kNone);
    const auto test = [&](std::span<const Pair> candidates) -> Result<void> {
      impacts_.toi.resize(candidates.size());
      Result<void> tested = impacts_of(candidates, {.toi = impacts_.toi.data()});
      for (size_t i = 0; tested && i < candidates.size(); ++i) {
        const Pair pair = candidates[i];
        const float toi = impacts_.toi[i];
        if (!is_hit(toi)) continue;
        float& least = limit[pair.a - first];
        uint32_t& body = best[pair.a - first];
        if (toi < least || (toi == least && pair.b < body)) body = pair.b;
        least = std::min(least, toi);
      }
      return tested;
    };
    Result<void> found = search_in_rounds(boxes_, bodies_, SearchFor::met, kForClosest, first,
                                          limit, parallelism_, test);
    if (!found) return found;
    std::vector<Pair> met;
    for (size_t i = 0; i < count; ++i) {
      if (best[i] != kNone) met.push_back({static_cast<uint32_t>(first + i), best[i]});
    }
    return met.empty() ? Result<void>{} : add_hits(met);
  }

  Result<void> add_hits(std::span<const Pair> candidates) {
    impacts_.resize(candidates.size());
    Result<void> tested = impacts_of(candidates, impacts_.columns());
    for (size_t i = 0; tested && i < candidates.size(); ++i) {
      if (is_hit(impacts_.toi[i])) hits_.push_back(impacts_.hit(candidates[i], i));
    }
    return tested;
  }

  Result<void> impacts_of(std::span<const Pair> candidates, const ImpactColumns& out) const {
    return time_of_impact(boxes_.queries(), sweep_, bodies_.bodies, {}, candidates, out,
                          {.frame = WitnessFrame::body, .parallelism = parallelism_});
  }

  static constexpr uint32_t kNone = 0xffffffffu;  // greater than every index

  const SweepView& sweep_;
  const SearchedBodies& bodies_;
  const QueryBoxes boxes_;
  std::vector<CastHit>& hits_;
  const Parallelism parallelism_;
  Impacts impacts_;
};

}  // namespace

Result<void> cast(const Collidables& queries, const SweepView& sweep, const SearchedBodies& bodies,
                  CastHits which, std::vector<CastHit>& hits, Parallelism parallelism) {
  const FloatEnvironment environment;
  hits.clear();
  return Caster(queries, sweep, bodies, hits, parallelism).run(which);
}

Result<void> cast(const Collidables& queries, const SweepView& sweep, const Collidables& bodies,
                  CastHits which, std::vector<CastHit>& hits, Parallelism parallelism) {
  const FloatEnvironment environment;
  const BodyIndex index = index_bodies(bodies, parallelism);
  return cast(queries, sweep, SearchedBodies{bodies, index}, which, hits, parallelism);
}

Rays::Rays(const float* origin, const float* direction, size_t count, float length,
           size_t origin_stride, size_t direction_stride)
    : origin_(origin), origin_stride_(origin_stride), displacements_(count) {
  const FloatEnvironment environment;
  for (size_t i = 0; i < count; ++i) {
    const auto d = load_strided<std::array<float, 3>>(direction, direction_stride, i);
    displacements_[i] = {d[0] * length, d[1] * length, d[2] * length};
  }
}

}  // namespace carom
