// Pairs of simple shapes.
#include <algorithm>
#include <cmath>

#include "bench/peers/narrowphase/compare.h"
#include "bench/peers/narrowphase/peer_bodies.h"

namespace carom::bench {
namespace {

constexpr double kMostWrong = 1e-5;  // error of separations, as a share of the mean bounding radius
constexpr size_t kOtherPairs = 20'000;  // of libraries beside Bullet, which take long

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

std::vector<Library> ask_all(const PeerStreamSpec& spec, const PairStream& stream) {
  PeerBodies a = peer_bodies(spec.a, stream.bodies_a());
  PeerBodies b = peer_bodies(spec.b, stream.bodies_b());
  const PeerDetail detail = peer_detail(spec);
  const std::vector<Truth> truths = truths_of(stream);
  std::vector<Library> libraries;
  libraries.push_back(ask("bullet", make_bullet_pairs(a, b, detail), truths));

  const size_t count = std::min(truths.size(), kOtherPairs);
  a.bodies.resize(count);
  b.bodies.resize(count);
  const auto add = [&](const char* name, MakePairPeer& make) {
    auto pairs = make(a, b, detail);
    if (pairs) libraries.push_back(ask(name, std::move(pairs), std::span(truths).first(count)));
  };
  add("fcl", make_fcl_pairs);
  add("ode", make_ode_pairs);
  add("ccd_gjk", make_ccd_gjk_pairs);
  add("ccd_mpr", make_ccd_mpr_pairs);
  add("mujoco", make_mujoco_pairs);
  return libraries;
}

// One pass of Carom. With `again` every other pass uses bodies one step further.
class CaromPass {
 public:
  CaromPass(const PairStream& stream, const PeerStreamSpec& spec, const ResultColumns& columns)
      : stream_(stream),
        spec_(spec),
        columns_(columns),
        features_(spec.again ? stream.spec().count : 0) {
    if (spec.again) columns_.features = features_.data();
  }

  void operator()() {
    is_next_ = !is_next_;
    if (spec_.again && is_next_) {
      (void)stream_.run_next_step(spec_.detail, columns_, spec_.measured);
    } else {
      (void)stream_.run(spec_.detail, columns_, spec_.measured);
    }
  }

 private:
  const PairStream& stream_;
  const PeerStreamSpec& spec_;
  ResultColumns columns_;
  std::vector<uint64_t> features_;
  bool is_next_ = false;
};

std::vector<RunnerResult> time_all(const PairStream& stream, const PeerStreamSpec& spec,
                                   std::vector<Library>& libraries, double budget) {
  ResultArrays results(stream.spec().count, Detail::manifold);
  std::vector<TimedRunner> runners = runners_of(libraries);
  add_carom(runners, stream.spec().count, [&] {
    return [pass = std::make_shared<CaromPass>(stream, spec, results.columns())] { (*pass)(); };
  });
  return time_in_turns(std::move(runners), budget);
}

}  // namespace

StreamResult compare_pairs(const PeerStreamSpec& spec, size_t pairs, double budget) {
  PairStream stream(
      {.kind_a = spec.a, .kind_b = spec.b, .count = pairs, .vertices = spec.vertices});
  if (spec.again) stream.draw_next_step();
  std::vector<Library> libraries = ask_all(spec, stream);
  StreamResult result = describe(spec, stream, libraries.front());
  result.wrong = difference(stream, spec.detail);
  if (spec.again && result.wrong.empty()) result.wrong = difference_again(stream, spec);
  if (!result.agrees()) return result;
  result.runners = time_all(stream, spec, libraries, budget);
  result.runners.push_back(reference_result(pairs, stream.reference_seconds()));
  return result;
}

}  // namespace carom::bench
