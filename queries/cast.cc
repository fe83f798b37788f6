#include "carom/queries/cast.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include "base/float_environment.h"
#include "base/outward.h"
#include "impacts/first_times.h"
#include "impacts/impact_contacts.h"
#include "midphase/collide_pairs.h"
#include "narrowphase/batch/column_memory.h"
#include "queries/query_rounds.h"
#include "queries/searches.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

// The first round tests few candidates, because the hit is mostly among the first.
constexpr RoundSizes kForOne = {.first = 2, .most = 8};
constexpr RoundSizes kForAll = {.first = 64, .most = 64};

constexpr float kFinished = -1;  // a limit that no candidate passes

// Candidates with their first times.
class Times {
 public:
  std::span<const Pair> pairs() const { return pairs_; }
  void clear() { resize(0); }
  void add(Pair pair, const FirstTime& first) {
    pairs_.push_back(pair);
    time_.push_back(first.time);
    status_.push_back(static_cast<uint8_t>(first.status));
    parts_.push_back(first.parts);
  }
  FirstTime at(size_t i) const { return {time_[i], static_cast<Status>(status_[i]), parts_[i]}; }

  // Finds the times of candidates, or with `any` whether there are times. latest(pair): a time
  // after which none is of use.
  template <class Latest>
  void find(const MovingSide& queries, const MovingSide& bodies, std::span<const Pair> candidates,
            bool any, Parallelism parallelism, const Latest& latest) {
    pairs_.assign(candidates.begin(), candidates.end());
    resize(candidates.size());
    for_each_block(pairs_.size(), kPairsPerBlock, parallelism,
                   [&](size_t, size_t begin, size_t end) {
                     std::array<double, kPairsPerBlock> limit;
                     for (size_t i = begin; i < end; ++i) limit[i - begin] = latest(pairs_[i]);
                     find_first_times(queries, bodies, pairs().subspan(begin, end - begin),
                                      {limit.data(), any}, columns(begin));
                   });
  }

  FirstTimes block(size_t begin, size_t end) const {
    return {time_.data() + begin, parts_.data() + begin, end - begin};
  }

 private:
  void resize(size_t count) {
    pairs_.resize(count);
    time_.resize(count);
    status_.resize(count);
    parts_.resize(count);
  }
  FirstTimeColumns columns(size_t begin) {
    return {time_.data() + begin, status_.data() + begin, parts_.data() + begin};
  }

  std::vector<Pair> pairs_;
  std::vector<double> time_;
  std::vector<uint8_t> status_;
  std::vector<std::array<uint64_t, 2>> parts_;
};

// The contacts at the first times.
struct Contacts {
  std::vector<float> separation;
  std::array<std::vector<float>, 3> normal, point;

  void resize(size_t count) {
    separation.resize(count);
    for (size_t axis = 0; axis < 3; ++axis) {
      normal[axis].resize(count);
      point[axis].resize(count);
    }
  }

  ImpactColumns columns(size_t begin) {
    const auto three = [begin](std::array<std::vector<float>, 3>& v) -> std::array<float*, 3> {
      return {v[0].data() + begin, v[1].data() + begin, v[2].data() + begin};
    };
    return {
        .separation = separation.data() + begin, .normal = three(normal), .point_b = three(point)};
  }
};

bool is_hit(double time) { return time <= 1; }

std::optional<bool> one_sided(Backfaces backfaces) {
  if (backfaces == Backfaces::as_made) return std::nullopt;
  return backfaces == Backfaces::ignore;
}

class Caster {
 public:
  Caster(const Collidables& queries, const SweepView& sweep, const SearchedBodies& bodies,
         const CastOptions& options, std::vector<CastHit>& hits)
      : bodies_(bodies),
        moving_{.bodies = queries, .sweep = sweep, .one_sided = one_sided(options.backfaces)},
        still_{.bodies = bodies.bodies, .sweep = {}, .one_sided = moving_.one_sided},
        boxes_(queries, sweep),
        which_(options.hits),
        hits_(hits),
        parallelism_(options.parallelism) {}

  Result<void> run() {
    for (size_t first = 0; first < boxes_.count(); first += kQueriesAtOnce) {
      const size_t count = std::min(kQueriesAtOnce, boxes_.count() - first);
      Result<void> done = which_ == CastHits::all ? find_all(first, count) : find_one(first, count);
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
    const auto test = [&](std::span<const Pair> candidates) -> Result<void> {
      Result<void> tested = find_times(candidates, [](Pair) { return 1.0; });
      if (tested) add_hits(times_);
      return tested;
    };
    Result<void> found = search_in_rounds(boxes_, bodies_, SearchFor::met, kForAll, first, limit,
                                          parallelism_, memory_, test);
    std::sort(hits_.begin() + static_cast<ptrdiff_t>(before), hits_.end(),
              [](const CastHit& a, const CastHit& b) {
                return std::tie(a.query, a.toi, a.body) < std::tie(b.query, b.toi, b.body);
              });
    return found;
  }

  // Finds the first time of each query, or any, then the contacts of the first hits.
  Result<void> find_one(size_t first, size_t count) {
    const bool any = which_ == CastHits::any;
    std::vector<float> limit(count, 1.0f);
    std::vector<Best> best(count);
    const auto test = [&](std::span<const Pair> candidates) -> Result<void> {
      // Of times that round to the same float the lowest body counts.
      Result<void> tested = find_times(
          candidates, [&](Pair pair) -> double { return next_up(limit[pair.a - first]); });
      for (size_t i = 0; tested && i < candidates.size(); ++i) {
        const Pair pair = candidates[i];
        const FirstTime time = times_.at(i);
        if (!is_hit(time.time)) continue;
        const float toi = round_downwards(time.time);
        float& least = limit[pair.a - first];
        Best& kept = best[pair.a - first];
        if (any) {
          kept.body = pair.b;
          least = kFinished;
        } else if (toi < least || (toi == least && pair.b < kept.body)) {
          kept = {pair.b, time};
          least = toi;
        }
      }
      return tested;
    };
    Result<void> found = search_in_rounds(boxes_, bodies_, SearchFor::met, kForOne, first, limit,
                                          parallelism_, memory_, test);
    if (!found) return found;
    times_.clear();
    for (size_t i = 0; i < count; ++i) {
      if (best[i].body == kNoBody) continue;
      const auto query = static_cast<uint32_t>(first + i);
      if (any) {
        hits_.push_back(some_hit(query));
      } else {
        times_.add({query, best[i].body}, best[i].first);
      }
    }
    add_hits(times_);
    return {};
  }

  template <class Latest>
  Result<void> find_times(std::span<const Pair> candidates, const Latest& latest) {
    Result<void> checked = check_pairs(moving_.bodies, still_.bodies, candidates);
    if (checked) {
      times_.find(moving_, still_, candidates, which_ == CastHits::any, parallelism_, latest);
    }
    return checked;
  }

  void add_hits(const Times& times) {
    const std::span<const Pair> pairs = times.pairs();
    contacts_.resize(pairs.size());
    for_each_block(
        pairs.size(), kPairsPerBlock, parallelism_, [&](size_t, size_t begin, size_t end) {
          find_impact_contacts(moving_, still_, pairs.data() + begin, times.block(begin, end),
                               WitnessFrame::body, contacts_.columns(begin));
        });
    const BodyReader bodies{still_.bodies};
    for (size_t i = 0; i < pairs.size(); ++i) {
      const FirstTime first = times.at(i);
      if (!is_hit(first.time)) continue;
      const auto three = [i](const std::array<std::vector<float>, 3>& v) -> Eigen::Vector3f {
        return {v[0][i], v[1][i], v[2][i]};
      };
      hits_.push_back({.query = pairs[i].a,
                       .body = pairs[i].b,
                       .sub_shape = sub_shape(bodies.kind(pairs[i].b), first.parts[1]),
                       .toi = round_downwards(first.time),
                       .normal = three(contacts_.normal),
                       .point = three(contacts_.point),
                       .separation = contacts_.separation[i],
                       .status = first.status});
    }
  }

  static CastHit some_hit(uint32_t query) {
    return {.query = query,
            .body = kNoBody,
            .sub_shape = 0,
            .toi = 0,
            .normal = Eigen::Vector3f::Zero(),
            .point = Eigen::Vector3f::Zero(),
            .separation = 0,
            .status = Status::ok};
  }

  struct Best {
    uint32_t body = kNoBody;  // greater than every index
    FirstTime first{};
  };

  const SearchedBodies& bodies_;
  const MovingSide moving_, still_;
  QueryBoxes boxes_;
  const CastHits which_;
  std::vector<CastHit>& hits_;
  const Parallelism parallelism_;
  SearchMemory memory_;
  Times times_;
  Contacts contacts_;
};

}  // namespace

Result<void> cast(const Collidables& queries, const SweepView& sweep, const SearchedBodies& bodies,
                  std::vector<CastHit>& hits, const CastOptions& options) {
  const FloatEnvironment environment;
  hits.clear();
  return Caster(queries, sweep, bodies, options, hits).run();
}

Result<void> cast(const Collidables& queries, const SweepView& sweep, const Collidables& bodies,
                  std::vector<CastHit>& hits, const CastOptions& options) {
  const FloatEnvironment environment;
  const BodyIndex index = index_bodies(bodies, options.parallelism);
  return cast(queries, sweep, SearchedBodies{bodies, index, options.filter}, hits, options);
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
