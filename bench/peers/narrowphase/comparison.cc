#include "bench/peers/narrowphase/comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>

#include "bench/peers/narrowphase/pair_peer.h"
#include "bench/peers/narrowphase/peer_bodies.h"
#include "bench/support/measure.h"
#include "bench/support/mesh_stream.h"
#include "bench/support/motion_stream.h"
#include "bench/support/pair_stream.h"

namespace carom::bench {
namespace {

constexpr double kBand = 1e-3;  // of the mean bounding radius; pairs nearer to touch are excluded
constexpr double kMostDifferent = 1e-3;  // share of Bullet's decisions
constexpr double kMostWrong = 1e-5;      // error of separations, as a share of that radius
constexpr int kTurns = 5;

double mean_radius(const PlacedShape& a, const PlacedShape& b) {
  return (local_bounds(a).diagonal().norm() + local_bounds(b).diagonal().norm()) / 4;
}

void compare_decision(float separation, double radius, bool bullet, StreamResult& result) {
  if (std::fabs(separation) <= kBand * radius) {
    ++result.excluded;
  } else if ((separation <= 0) != bullet) {
    ++result.different;
  }
}

void compare_decisions(const PairStream& stream, std::span<const uint8_t> bullet,
                       StreamResult& result) {
  for (size_t i = 0; i < bullet.size(); ++i) {
    compare_decision(stream.expected(i).separation,
                     mean_radius(stream.bodies_a()[i], stream.bodies_b()[i]), bullet[i] != 0,
                     result);
  }
}

void compare_decisions(const MeshStream& stream, std::span<const uint8_t> bullet,
                       StreamResult& result) {
  for (size_t i = 0; i < bullet.size(); ++i) {
    const PlacedShape& body = stream.bodies()[i];
    compare_decision(stream.separation(i), mean_radius(body, body), bullet[i] != 0, result);
  }
}

// Why Carom's results differ from its reference; empty if they do not.
template <class Stream>
std::string difference(const Stream& stream, Detail detail) {
  ResultArrays results(stream.spec().count, Detail::manifold);
  for (const Isa isa : usable_isas()) {
    force_isa(isa);
    spoil(results);
    if (const Result<void> done = stream.run(detail, results.columns()); !done) {
      return done.error().message;
    }
    if (const auto found = stream.difference(detail, results.columns())) {
      return std::string(name(isa)) + ": " + *found;
    }
  }
  return "";
}

// Why results with features of the last step differ from results without, beyond the stated error;
// empty if they do not.
std::string difference_again(const PairStream& stream, const PeerStreamSpec& spec) {
  const size_t count = stream.spec().count;
  std::vector<uint64_t> features(count);
  ResultArrays arrays(count, Detail::manifold), cold_arrays(count, Detail::manifold);
  ResultColumns warm = arrays.columns();
  const ResultColumns& cold = cold_arrays.columns();
  warm.features = features.data();
  for (const Isa isa : usable_isas()) {
    force_isa(isa);
    std::fill(features.begin(), features.end(), 0);
    (void)stream.run(spec.detail, warm, spec.measured);
    (void)stream.run_next_step(spec.detail, warm, spec.measured);
    (void)stream.run_next_step(spec.detail, cold, spec.measured);
    for (size_t i = 0; i < count; ++i) {
      const double most = kMostWrong * mean_radius(stream.bodies_a()[i], stream.bodies_b()[i]);
      const bool is_near = cold.overlap[i] != 0 ||
                           std::fabs(double{warm.separation[i]} - cold.separation[i]) <= most;
      if (warm.overlap[i] != cold.overlap[i] || !is_near) {
        return std::string(name(isa)) + ": row " + std::to_string(i) + " differs when it is known";
      }
    }
  }
  return "";
}

PeerDetail peer_detail(const PeerStreamSpec& spec) {
  if (spec.measured != Measured::overlapping) return PeerDetail::distance;
  if (spec.detail == Detail::overlap) return PeerDetail::overlap;
  return spec.detail == Detail::manifold ? PeerDetail::manifold : PeerDetail::contact;
}

// A library beside Bullet.
struct OtherPeer {
  const char* name;
  std::unique_ptr<PairPeer> pairs;
  size_t different;
};
using OtherPeers = std::vector<OtherPeer>;

OtherPeers other_peers(const PeerStreamSpec& spec, const PairStream& stream) {
  const PeerBodies a = peer_bodies(spec.a, stream.bodies_a());
  const PeerBodies b = peer_bodies(spec.b, stream.bodies_b());
  OtherPeers peers;
  std::vector<uint8_t> overlaps(stream.spec().count);
  const auto add = [&](const char* name, std::unique_ptr<PairPeer> pairs) {
    if (!pairs) return;
    StreamResult result;
    pairs->run(overlaps);
    compare_decisions(stream, overlaps, result);
    peers.push_back({name, std::move(pairs), result.different});
  };
  add("fcl", make_fcl_pairs(a, b, peer_detail(spec)));
  add("ode", make_ode_pairs(a, b, peer_detail(spec)));
  return peers;
}

// Processor time of this process, which other programs do not disturb.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class TimedRunner {
 public:
  TimedRunner(std::string name, std::function<void()> pass, std::optional<Isa> isa = std::nullopt,
              size_t different = 0)
      : name_(std::move(name)), pass_(std::move(pass)), isa_(isa), different_(different) {}

  // The first pass is not timed, because the runner before has filled the caches.
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
    return {name_, times_.size(), times_[times_.size() / 2], times_.front(), different_};
  }

 private:
  std::string name_;
  std::function<void()> pass_;
  std::optional<Isa> isa_;
  size_t different_;
  std::vector<double> times_;
};

// One pass of Carom. With `again` every other pass uses bodies one step further.
template <class Stream>
class CaromPass {
 public:
  CaromPass(const Stream& stream, const PeerStreamSpec& spec, const ResultColumns& columns)
      : stream_(stream),
        spec_(spec),
        columns_(columns),
        features_(spec.again ? stream.spec().count : 0) {
    if (spec.again) columns_.features = features_.data();
  }

  void operator()() {
    if constexpr (std::is_same_v<Stream, PairStream>) {
      is_next_ = !is_next_;
      if (spec_.again && is_next_) {
        (void)stream_.run_next_step(spec_.detail, columns_, spec_.measured);
        return;
      }
    }
    (void)stream_.run(spec_.detail, columns_, spec_.measured);
  }

 private:
  const Stream& stream_;
  const PeerStreamSpec& spec_;
  ResultColumns columns_;
  std::vector<uint64_t> features_;
  bool is_next_ = false;
};

// Times all runners in turns, so that a drift of the machine's clock affects all of them.
// `reference_seconds` was measured when the stream was made.
std::vector<RunnerResult> time_in_turns(std::vector<TimedRunner> runners, double budget,
                                        double reference_seconds) {
  for (int turn = 0; turn < kTurns; ++turn) {
    for (TimedRunner& runner : runners) runner.take_turn(budget / kTurns);
  }
  unforce_isa();
  std::vector<RunnerResult> timed;
  for (TimedRunner& runner : runners) timed.push_back(runner.result());
  timed.push_back({"reference", 1, reference_seconds, reference_seconds, 0});
  return timed;
}

template <class Stream>
std::vector<RunnerResult> time_in_turns(const Stream& stream, const PeerStreamSpec& spec,
                                        PairPeer& bullet, const OtherPeers& others, double budget) {
  ResultArrays results(stream.spec().count, Detail::manifold);
  std::vector<uint8_t> overlaps(stream.spec().count);
  std::vector<TimedRunner> runners;
  runners.emplace_back("bullet", [&] { bullet.run(overlaps); });
  for (const OtherPeer& other : others) {
    runners.emplace_back(
        other.name, [&] { other.pairs->run(overlaps); }, std::nullopt, other.different);
  }
  for (const Isa isa : usable_isas()) {
    const auto pass = std::make_shared<CaromPass<Stream>>(stream, spec, results.columns());
    runners.emplace_back(
        name(isa), [pass] { (*pass)(); }, isa);
  }
  return time_in_turns(std::move(runners), budget, stream.reference_seconds());
}

// Both of Bullet's casts.
struct BulletCasts {
  std::unique_ptr<PairPeer> continuous, gjk;

  BulletCasts(const PeerStreamSpec& spec, const MotionStream& stream) {
    std::vector<std::array<float, 3>> displacements;
    for (const Eigen::Vector3f& d : stream.displacements()) {
      displacements.push_back({d.x(), d.y(), d.z()});
    }
    const PeerBodies a = peer_bodies(spec.a, stream.bodies_a());
    const PeerBodies b = peer_bodies(spec.b, stream.bodies_b());
    continuous = make_bullet_casts(a, b, displacements, PeerCast::continuous);
    gjk = make_bullet_casts(a, b, displacements, PeerCast::gjk);
  }
};

std::vector<RunnerResult> time_in_turns(const MotionStream& stream, Moving moving,
                                        BulletCasts& bullet, double budget) {
  const ImpactArrays results(stream.spec().count);
  const ImpactColumns columns = moving == Moving::times ? results.times_alone() : results.columns();
  std::vector<uint8_t> impacts(stream.spec().count);
  std::vector<TimedRunner> runners;
  runners.emplace_back("bullet", [&] { bullet.continuous->run(impacts); });
  runners.emplace_back("bullet_gjk", [&] { bullet.gjk->run(impacts); });
  for (const Isa isa : usable_isas()) {
    runners.emplace_back(
        name(isa), [&] { (void)stream.run(columns); }, isa);
  }
  return time_in_turns(std::move(runners), budget, stream.reference_seconds());
}

std::string difference(const MotionStream& stream) {
  ImpactArrays results(stream.spec().count);
  for (const Isa isa : usable_isas()) {
    force_isa(isa);
    (void)stream.run(results.columns());
    if (const auto found = stream.difference(results.columns())) {
      return std::string(name(isa)) + ": " + *found;
    }
  }
  return "";
}

// Bullet's casts give up on some impacts and count some near misses. The report shows how many;
// they are not faults.
StreamResult compare_motions(const PeerStreamSpec& spec, size_t pairs, double budget) {
  const MotionStream stream({.kind_a = spec.a, .kind_b = spec.b, .count = pairs});
  BulletCasts bullet(spec, stream);
  StreamResult result;
  result.pair = spec.name();
  result.output = spec.output();
  result.pairs = pairs;
  result.hit_percent = stream.hit_percent();
  result.wrong = difference(stream);
  std::vector<uint8_t> impacts(pairs);
  result.bullet_points = bullet.continuous->run(impacts);
  for (size_t i = 0; i < pairs; ++i) {
    result.different += (stream.expected(i).toi <= 1) != (impacts[i] != 0) ? 1 : 0;
  }
  if (result.wrong.empty()) {
    result.runners = time_in_turns(stream, spec.moving, bullet, budget);
  }
  return result;
}

template <class Stream>
StreamResult compare(const PeerStreamSpec& spec, const Stream& stream, PairPeer& bullet,
                     const OtherPeers& others, double budget) {
  StreamResult result;
  result.pair = spec.name();
  result.output = spec.output();
  result.pairs = stream.spec().count;
  result.hit_percent = stream.hit_percent();
  result.wrong = difference(stream, spec.detail);
  if constexpr (std::is_same_v<Stream, PairStream>) {
    if (spec.again && result.wrong.empty()) result.wrong = difference_again(stream, spec);
  }
  std::vector<uint8_t> overlaps(result.pairs);
  result.bullet_points = bullet.run(overlaps);
  compare_decisions(stream, overlaps, result);
  if (result.agrees()) result.runners = time_in_turns(stream, spec, bullet, others, budget);
  return result;
}

std::vector<PeerStreamSpec> moving_streams() {
  using enum ShapeKind;
  std::vector<PeerStreamSpec> streams;
  for (const Moving moving : {Moving::times, Moving::contacts}) {
    const auto add = [&](const char* pair, ShapeKind a, ShapeKind b, size_t vertices = 0) {
      streams.push_back({pair, a, b, Detail::contact, vertices, Measured::all, false, moving});
    };
    add("sphere_sphere", sphere, sphere);
    add("capsule_capsule", capsule, capsule);
    add("box_box", box, box);
    add("sphere_box", sphere, box);
    add("capsule_box", capsule, box);
    add("hull_hull", hull, hull, 16);
  }
  return streams;
}

std::vector<PeerStreamSpec> still_streams() {
  using enum ShapeKind;
  using enum Detail;
  using enum Measured;
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
          {"hull_hull", hull, hull, contact, 8, separate},
          {"hull_hull", hull, hull, contact, 16, separate},
          {"hull_hull", hull, hull, contact, 32, separate},
          {"hull_hull", hull, hull, contact, 64, separate},
          {"hull_hull", hull, hull, contact, 8, separate, true},
          {"hull_hull", hull, hull, contact, 16, separate, true},
          {"hull_hull", hull, hull, contact, 32, separate, true},
          {"hull_hull", hull, hull, contact, 8, all},
          {"hull_hull", hull, hull, contact, 16, all},
          {"hull_hull", hull, hull, contact, 32, all},
          {"hull_hull", hull, hull, contact, 64, all},
          {"hull_hull", hull, hull, contact, 8},
          {"hull_hull", hull, hull, contact, 16},
          {"hull_hull", hull, hull, contact, 32},
          {"hull_hull", hull, hull, manifold, 8},
          {"hull_hull", hull, hull, manifold, 16},
          {"hull_hull", hull, hull, manifold, 32},
          {"sphere_mesh", sphere, mesh, contact},
          {"capsule_mesh", capsule, mesh, contact},
          {"box_mesh", box, mesh, contact},
          {"hull_mesh", hull, mesh, contact, 16}};
}

}  // namespace

std::vector<PeerStreamSpec> peer_streams() {
  std::vector<PeerStreamSpec> streams = still_streams();
  const std::vector<PeerStreamSpec> moving = moving_streams();
  streams.insert(streams.end(), moving.begin(), moving.end());
  return streams;
}

std::string PeerStreamSpec::name() const {
  return vertices > 0 ? pair + ("_" + std::to_string(vertices)) : pair;
}

const char* PeerStreamSpec::output() const {
  if (moving != Moving::no) return moving == Moving::times ? "toi" : "impact";
  if (measured == Measured::overlapping) return bench::name(detail);
  if (again) return "again";
  return measured == Measured::separate ? "clearance" : "distance";
}

const RunnerResult* StreamResult::timed(const std::string& runner) const {
  const auto found = std::find_if(runners.begin(), runners.end(),
                                  [&](const RunnerResult& r) { return r.runner == runner; });
  return found == runners.end() ? nullptr : &*found;
}

bool StreamResult::agrees() const {
  const bool is_cast = output == "toi" || output == "impact";
  return wrong.empty() && (is_cast || static_cast<double>(different) <=
                                          kMostDifferent * static_cast<double>(pairs - excluded));
}

StreamResult compare(const PeerStreamSpec& spec, size_t pairs, double budget) {
  if (spec.moving != Moving::no) return compare_motions(spec, pairs, budget);
  if (spec.b == ShapeKind::mesh) {
    const MeshStream stream({.kind = spec.a, .count = pairs, .vertices = spec.vertices});
    const auto bullet =
        make_bullet_pairs(peer_bodies(spec.a, stream.bodies()),
                          peer_ground(stream.terrain(), pairs), PeerDetail::contact);
    return compare(spec, stream, *bullet, {}, budget);
  }
  PairStream stream(
      {.kind_a = spec.a, .kind_b = spec.b, .count = pairs, .vertices = spec.vertices});
  if (spec.again) stream.draw_next_step();
  const auto bullet = make_bullet_pairs(peer_bodies(spec.a, stream.bodies_a()),
                                        peer_bodies(spec.b, stream.bodies_b()), peer_detail(spec));
  return compare(spec, stream, *bullet, other_peers(spec, stream), budget);
}

}  // namespace carom::bench
