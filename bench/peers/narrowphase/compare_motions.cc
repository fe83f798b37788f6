// Bodies that move: times of impact.
#include <algorithm>

#include "bench/peers/narrowphase/compare.h"
#include "bench/peers/narrowphase/peer_bodies.h"
#include "bench/support/motion_stream.h"

namespace carom::bench {
namespace {

constexpr size_t kTurningPairs = 20'000;  // at most; the reference takes long for them

std::vector<std::array<float, 3>> plain(const std::vector<Eigen::Vector3f>& vectors) {
  std::vector<std::array<float, 3>> all;
  for (const Eigen::Vector3f& v : vectors) all.push_back({v.x(), v.y(), v.z()});
  return all;
}

// Bullet's casts; the second turns no bodies.
std::vector<Library> ask_bullet(const PeerStreamSpec& spec, const MotionStream& stream) {
  const PeerBodies a = peer_bodies(spec.a, stream.bodies_a());
  const PeerBodies b = peer_bodies(spec.b, stream.bodies_b());
  const PeerMotions motions = {plain(stream.displacements()), plain(stream.turns_a()),
                               plain(stream.turns_b())};
  const std::vector<Truth> truths = truths_of(stream);
  std::vector<Library> libraries;
  libraries.push_back(
      ask("bullet", make_bullet_casts(a, b, motions, PeerCast::continuous), truths));
  if (spec.moving == Moving::turning) return libraries;
  libraries.push_back(ask("bullet_gjk", make_bullet_casts(a, b, motions, PeerCast::gjk), truths));
  return libraries;
}

std::string difference(const MotionStream& stream) {
  const ImpactArrays results(stream.spec().count);
  for (const Isa isa : usable_isas()) {
    force_isa(isa);
    (void)stream.run(results.columns());
    if (const auto found = stream.difference(results.columns())) {
      return std::string(name(isa)) + ": " + *found;
    }
  }
  return "";
}

}  // namespace

StreamResult compare_motions(const PeerStreamSpec& spec, size_t pairs, double budget) {
  const bool is_turning = spec.moving == Moving::turning;
  const size_t count = is_turning ? std::min(pairs, kTurningPairs) : pairs;
  const MotionStream stream(
      {.kind_a = spec.a, .kind_b = spec.b, .turning = is_turning, .count = count});
  std::vector<Library> libraries = ask_bullet(spec, stream);
  StreamResult result = describe(spec, stream, libraries.front());
  result.wrong = difference(stream);
  if (!result.agrees()) return result;

  const ImpactArrays results(count);
  const ImpactColumns columns =
      spec.moving == Moving::contacts ? results.columns() : results.times_alone();
  std::vector<TimedRunner> runners = runners_of(libraries);
  add_carom(runners, count, [&] { return [&] { (void)stream.run(columns); }; });
  result.runners = time_in_turns(std::move(runners), budget);
  result.runners.push_back(reference_result(count, stream.reference_seconds()));
  return result;
}

}  // namespace carom::bench
