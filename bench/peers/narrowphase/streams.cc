#include "bench/peers/narrowphase/streams.h"

#include "bench/support/pair_stream.h"

namespace carom::bench {
namespace {

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
  streams.push_back(
      {"hull_hull", hull, hull, Detail::contact, 16, Measured::all, false, Moving::turning});
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
          {"sphere_cylinder", sphere, cylinder, contact},
          {"sphere_cone", sphere, cone, contact},
          {"sphere_ellipsoid", sphere, ellipsoid, contact},
          {"capsule_cylinder", capsule, cylinder, contact},
          {"box_cylinder", box, cylinder, contact},
          {"hull_cylinder", hull, cylinder, contact, 16},
          {"cylinder_cylinder", cylinder, cylinder, contact},
          {"ellipsoid_ellipsoid", ellipsoid, ellipsoid, contact},
          {"sphere_mesh", sphere, mesh, contact},
          {"capsule_mesh", capsule, mesh, contact},
          {"box_mesh", box, mesh, contact},
          {"hull_mesh", hull, mesh, contact, 16},
          {"mesh_mesh", mesh, mesh, contact}};
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
  switch (moving) {
    case Moving::times:
      return "toi";
    case Moving::contacts:
      return "impact";
    case Moving::turning:
      return "turning";
    case Moving::no:
      break;
  }
  if (measured == Measured::overlapping) return bench::name(detail);
  if (again) return "again";
  return measured == Measured::separate ? "clearance" : "distance";
}

}  // namespace carom::bench
