// Bodies on a mesh that does not move.
#include "bench/peers/narrowphase/compare.h"
#include "bench/peers/narrowphase/peer_bodies.h"
#include "bench/support/mesh_stream.h"

namespace carom::bench {

StreamResult compare_on_terrain(const PeerStreamSpec& spec, size_t pairs, double budget) {
  const MeshStream stream({.kind = spec.a, .count = pairs, .vertices = spec.vertices});
  const PeerBodies bodies = peer_bodies(spec.a, stream.bodies());
  const PeerBodies ground = peer_meshes(stream.terrain().vertices, stream.terrain().triangles,
                                        std::vector<PlacedShape>(pairs));
  std::vector<Library> libraries;
  libraries.push_back(
      ask("bullet", make_bullet_pairs(bodies, ground, PeerDetail::contact), truths_of(stream)));
  StreamResult result = describe(spec, stream, libraries.front());
  result.wrong = difference(stream, spec.detail);
  if (!result.agrees()) return result;

  const ResultArrays results(pairs, Detail::manifold);
  std::vector<TimedRunner> runners = runners_of(libraries);
  add_carom(runners, pairs, [&] {
    return [&] { (void)stream.run(spec.detail, results.columns(), spec.measured); };
  });
  result.runners = time_in_turns(std::move(runners), budget);
  result.runners.push_back(reference_result(pairs, stream.reference_seconds()));
  return result;
}

}  // namespace carom::bench
