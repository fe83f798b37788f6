// Two meshes.
#include <algorithm>

#include "bench/peers/narrowphase/compare.h"
#include "bench/peers/narrowphase/mesh_pairs.h"

namespace carom::bench {
namespace {

constexpr size_t kMeshPairs = 500;  // at most; libraries take up to a millisecond for one

}  // namespace

StreamResult compare_meshes(const PeerStreamSpec& spec, size_t pairs, double budget) {
  const MeshPairs stream({.count = std::min(pairs, kMeshPairs)});
  const PeerBodies a = stream.peer_a(), b = stream.peer_b();
  std::vector<Library> libraries;
  const auto add = [&](const char* name, MakePairPeer& make) {
    libraries.push_back(ask(name, make(a, b, PeerDetail::contact), stream.truths()));
  };
  add("bullet", make_bullet_pairs);
  add("fcl", make_fcl_mesh_pairs);
  add("fcl_first", make_fcl_first_mesh_pairs);
  StreamResult result = describe(spec, stream, libraries.front());
  result.wrong = stream.difference(spec.detail);
  if (!result.agrees()) return result;

  const ResultArrays results(stream.spec().count, Detail::manifold);
  std::vector<TimedRunner> runners = runners_of(libraries);
  add_carom(runners, stream.spec().count, [&] {
    return [&] { (void)stream.run(spec.detail, results.columns(), spec.measured); };
  });
  result.runners = time_in_turns(std::move(runners), budget);
  return result;
}

}  // namespace carom::bench
