#include "bench/peers/narrowphase/comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <map>
#include <optional>

#include "bench/peers/narrowphase/pair_peer.h"
#include "bench/support/measure.h"
#include "bench/support/pair_stream.h"

namespace carom::bench {
namespace {

constexpr double kBand = 1e-3;           // of the mean bounding radius: nearer touch is excluded
constexpr double kMostDifferent = 1e-3;  // of Bullet's decisions
constexpr int kTurns = 5;

std::array<float, 9> peer_size(const Sphere& sphere) { return {sphere.radius}; }
std::array<float, 9> peer_size(const Capsule& capsule) { return {capsule.radius, capsule.b.y()}; }
std::array<float, 9> peer_size(const Aabb& box) {
  return {box.upper.x(), box.upper.y(), box.upper.z()};
}
std::array<float, 9> peer_size(const Box& box) {
  return {box.half.x(), box.half.y(), box.half.z()};
}
std::array<float, 9> peer_size(const Triangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return {a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z()};
}
// Hulls have points in place of sizes; of the others there are no streams.
template <class Other>
std::array<float, 9> peer_size(const Other& /*shape*/) {
  return {};
}

PeerShape peer_shape(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere:
      return PeerShape::sphere;
    case ShapeKind::capsule:
      return PeerShape::capsule;
    case ShapeKind::triangle:
      return PeerShape::triangle;
    case ShapeKind::hull:
      return PeerShape::hull;
    default:
      return PeerShape::box;
  }
}

// Each geometry once.
class PeerHulls {
 public:
  explicit PeerHulls(std::vector<std::vector<std::array<float, 3>>>& all) : all_(all) {}

  // 0 of what is no hull.
  size_t place_of(const Shape& shape) {
    const auto* hull = std::get_if<Hull>(&shape);
    if (!hull) return 0;
    const auto [found, is_new] = places_.emplace(hull->geometry.get(), all_.size());
    if (is_new) {
      all_.emplace_back();
      for (const Eigen::Vector3f& p : hull->geometry->points()) {
        all_.back().push_back({p.x(), p.y(), p.z()});
      }
    }
    return found->second;
  }

 private:
  std::vector<std::vector<std::array<float, 3>>>& all_;
  std::map<const HullGeometry*, size_t> places_;
};

// Boxes along the axes are boxes that are not turned.
PeerBodies peer_bodies(ShapeKind kind, const std::vector<PlacedShape>& bodies) {
  PeerBodies all = {peer_shape(kind), {}, {}};
  PeerHulls hulls(all.hulls);
  for (const PlacedShape& body : bodies) {
    const Eigen::Vector3f p = body.position.cast<float>();
    const Eigen::Vector4f q = body.orientation.coeffs();
    all.bodies.push_back(
        {{p.x(), p.y(), p.z()},
         {q.x(), q.y(), q.z(), q.w()},
         std::visit([](const auto& shape) { return peer_size(shape); }, body.shape),
         hulls.place_of(body.shape)});
  }
  return all;
}

double mean_radius(const PlacedShape& a, const PlacedShape& b) {
  return (local_bounds(a).diagonal().norm() + local_bounds(b).diagonal().norm()) / 4;
}

void compare_decisions(const PairStream& stream, std::span<const uint8_t> bullet,
                       StreamResult& result) {
  for (size_t i = 0; i < bullet.size(); ++i) {
    const reference::PairResult& expected = stream.expected(i);
    const double radius = mean_radius(stream.bodies_a()[i], stream.bodies_b()[i]);
    if (std::fabs(expected.separation) <= kBand * radius) {
      ++result.excluded;
    } else if (expected.overlap != (bullet[i] != 0)) {
      ++result.different;
    }
  }
}

// Why Carom's results are not those of its reference.
std::string difference(const PairStream& stream, Detail detail) {
  ResultArrays results(stream.spec().count);
  for (const Isa isa : usable_isas()) {
    force_isa(isa);
    results.spoil();
    if (const Result<void> done = stream.run(detail, results.columns()); !done) {
      return done.error().message;
    }
    if (const auto found = stream.difference(detail, results.columns())) {
      return std::string(name(isa)) + ": " + *found;
    }
  }
  return "";
}

PeerDetail peer_detail(const PeerStreamSpec& spec) {
  if (spec.distance) return PeerDetail::distance;
  return spec.detail == Detail::overlap ? PeerDetail::overlap : PeerDetail::contact;
}

// Of this process, so that other programs on the machine do not count.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class TimedRunner {
 public:
  TimedRunner(std::string name, std::function<void()> pass, std::optional<Isa> isa = std::nullopt)
      : name_(std::move(name)), pass_(std::move(pass)), isa_(isa) {}

  // The first pass is not timed: others have had the caches.
  void take_turn(double seconds) {
    if (isa_) force_isa(*isa_);
    pass_();
    const Stopwatch turn;
    do {
      const double start = processor_seconds();
      pass_();
      times_.push_back(processor_seconds() - start);
    } while (turn.seconds() < seconds);
  }

  RunnerResult result() {
    std::sort(times_.begin(), times_.end());
    return {name_, times_.size(), times_[times_.size() / 2], times_.front()};
  }

 private:
  std::string name_;
  std::function<void()> pass_;
  std::optional<Isa> isa_;
  std::vector<double> times_;
};

// So that the drift of a machine's clock meets all alike.
std::vector<RunnerResult> time_in_turns(const PairStream& stream, const PeerStreamSpec& spec,
                                        PairPeer& bullet, double budget) {
  ResultArrays results(stream.spec().count);
  std::vector<reference::PairResult> reference_results;
  std::vector<uint8_t> overlaps(stream.spec().count);
  std::vector<TimedRunner> runners;
  runners.emplace_back("bullet", [&] { bullet.run(overlaps); });
  runners.emplace_back("reference", [&] { stream.run_reference(reference_results); });
  for (const Isa isa : usable_isas()) {
    // Bullet's contacts say nothing of pairs that are apart.
    const auto separate = spec.distance ? SeparatePairs::measured : SeparatePairs::decided;
    const auto pass = [&, separate] { (void)stream.run(spec.detail, results.columns(), separate); };
    runners.emplace_back(name(isa), pass, isa);
  }
  for (int turn = 0; turn < kTurns; ++turn) {
    for (TimedRunner& runner : runners) runner.take_turn(budget / kTurns);
  }
  unforce_isa();
  std::vector<RunnerResult> timed;
  for (TimedRunner& runner : runners) timed.push_back(runner.result());
  return timed;
}

}  // namespace

std::vector<PeerStreamSpec> peer_streams() {
  using enum ShapeKind;
  using enum Detail;
  return {{"sphere_sphere", sphere, sphere, contact},
          {"sphere_box", sphere, box, contact},
          {"sphere_aabb", sphere, aabb, contact},
          {"sphere_capsule", sphere, capsule, contact},
          {"capsule_capsule", capsule, capsule, contact},
          {"capsule_box", capsule, box, contact},
          {"box_box", box, box, overlap},
          {"box_box", box, box, manifold},
          {"sphere_triangle", sphere, triangle, contact},
          {"capsule_triangle", capsule, triangle, contact},
          {"box_triangle", box, triangle, contact},
          {"hull_hull", hull, hull, contact, 8, true},
          {"hull_hull", hull, hull, contact, 16, true},
          {"hull_hull", hull, hull, contact, 32, true},
          {"hull_hull", hull, hull, contact, 64, true},
          {"hull_hull", hull, hull, contact, 8},
          {"hull_hull", hull, hull, contact, 16},
          {"hull_hull", hull, hull, contact, 32},
          {"hull_hull", hull, hull, manifold, 8},
          {"hull_hull", hull, hull, manifold, 16},
          {"hull_hull", hull, hull, manifold, 32}};
}

std::string PeerStreamSpec::name() const {
  return vertices > 0 ? pair + ("_" + std::to_string(vertices)) : pair;
}

const RunnerResult* StreamResult::timed(const std::string& runner) const {
  const auto found = std::find_if(runners.begin(), runners.end(),
                                  [&](const RunnerResult& r) { return r.runner == runner; });
  return found == runners.end() ? nullptr : &*found;
}

bool StreamResult::agrees() const {
  return wrong.empty() &&
         static_cast<double>(different) <= kMostDifferent * static_cast<double>(pairs - excluded);
}

StreamResult compare(const PeerStreamSpec& spec, size_t pairs, double budget) {
  const PairStream stream(
      {.kind_a = spec.a, .kind_b = spec.b, .count = pairs, .vertices = spec.vertices});
  const std::unique_ptr<PairPeer> bullet =
      make_bullet_pairs(peer_bodies(spec.a, stream.bodies_a()),
                        peer_bodies(spec.b, stream.bodies_b()), peer_detail(spec));
  StreamResult result;
  result.pair = spec.name();
  result.output = spec.distance ? "distance" : name(spec.detail);
  result.pairs = pairs;
  result.hit_percent = stream.hit_percent();
  result.wrong = difference(stream, spec.detail);
  std::vector<uint8_t> overlaps(pairs);
  result.bullet_points = bullet->run(overlaps);
  compare_decisions(stream, overlaps, result);
  if (!result.agrees()) return result;

  result.runners = time_in_turns(stream, spec, *bullet, budget);
  return result;
}

}  // namespace carom::bench
