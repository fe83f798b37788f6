#include "cli/advise/pair_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "carom/narrowphase/collide.h"
#include "cli/pairs/body_columns.h"

namespace carom::cli {
namespace {

// Below this distance, as a share of the pair's mean radius, float32 may not decide; see
// Tier::fast.
constexpr double kNear = 0x1p-17;

BodyColumns columns_of(const LoadedScene& scene, const io::SceneFrame& frame) {
  BodyColumns columns(scene.positions());
  const size_t bodies = scene.info().bodies;
  columns.reserve(bodies);
  for (size_t i = 0; i < bodies; ++i) {
    const BodyDesc body = scene.player().body(frame, i);
    columns.push(body.shape, {body.position, body.orientation});
  }
  return columns;
}

// Candidate pairs of one frame, without earlier frames.
Result<std::vector<Pair>> candidates(const LoadedScene& scene, size_t frame) {
  World world(
      {.positions = scene.positions(), .detail = Detail::pairs, .parallelism = Parallelism::none});
  scene.start(world);
  if (frame > 0) scene.move(frame, world);
  const StepReport& report = world.step();
  if (!report.search.complete) {
    return Error{scene.name() + ": frame " + std::to_string(frame) + " has " +
                 std::to_string(report.search.pairs) +
                 " pairs of overlapping bounds, more than the limit of " +
                 std::to_string(world.settings().most_pairs)};
  }
  return std::vector<Pair>(world.pairs().begin(), world.pairs().end());
}

class PairCounter {
 public:
  explicit PairCounter(const std::vector<double>& radius) : radius_(radius) {}

  Result<void> add_frame(const BodyColumns& columns, const std::vector<Pair>& pairs) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<uint8_t> overlap(pairs.size());
    std::vector<float> separation(pairs.size());
    std::vector<float> bound(pairs.size(), nan);
    ResultColumns out;
    out.overlap = overlap.data();
    out.separation = separation.data();
    out.separation_bound = bound.data();
    const Collidables bodies = columns.view();
    if (Result<void> done = collide(bodies, bodies, pairs, Detail::contact, out); !done) {
      return done;
    }
    ++survey_.frames;
    for (size_t i = 0; i < pairs.size(); ++i) {
      add_pair(bodies, pairs[i], overlap[i] == 1, separation[i], bound[i]);
    }
    return {};
  }

  PairSurvey finish() {
    for (const auto& [kinds, counts] : counts_) {
      survey_.kinds.push_back(
          {std::string(name(kinds[0])) + "-" + name(kinds[1]), counts.pairs, counts.overlaps});
    }
    return std::move(survey_);
  }

 private:
  struct Counts {
    uint64_t pairs = 0;
    uint64_t overlaps = 0;
  };

  void add_pair(const Collidables& bodies, Pair pair, bool overlaps, double separation,
                double bound) {
    ++survey_.pairs;
    survey_.overlaps += overlaps;
    survey_.near += std::abs(separation) <= kNear * mean_radius(pair);
    if (std::isfinite(bound)) survey_.error_bound = std::max(survey_.error_bound, bound);
    std::array kinds = {kind_of(bodies, pair.a), kind_of(bodies, pair.b)};
    std::sort(kinds.begin(), kinds.end());
    Counts& counts = counts_[kinds];
    ++counts.pairs;
    counts.overlaps += overlaps;
  }

  static ShapeKind kind_of(const Collidables& bodies, uint32_t body) {
    return bodies.kind ? bodies.kind[body] : bodies.uniform_kind;
  }

  // With a half-space: the other body's radius.
  double mean_radius(Pair pair) const {
    const double a = radius_[pair.a];
    const double b = radius_[pair.b];
    return std::isfinite(a) && std::isfinite(b) ? (a + b) / 2 : std::min(a, b);
  }

  const std::vector<double>& radius_;
  PairSurvey survey_;
  std::map<std::array<ShapeKind, 2>, Counts> counts_;
};

}  // namespace

Result<PairSurvey> survey_pairs(const LoadedScene& scene, const std::vector<double>& radius) {
  PairCounter counter(radius);
  const size_t last = scene.frames() - 1;
  for (const size_t frame : std::set<size_t>{0, last / 2, last}) {
    Result<std::vector<Pair>> pairs = candidates(scene, frame);
    if (!pairs) return pairs.error();
    const BodyColumns columns = columns_of(scene, scene.frame(frame));
    if (Result<void> added = counter.add_frame(columns, *pairs); !added) return added.error();
  }
  return counter.finish();
}

}  // namespace carom::cli
