// A program as users build it, with flags that the library was not built with. It hands over and
// takes back everything that holds vectors and quaternions, and prints sizes and results: programs
// with other flags must print the same.
#include "tests/abi/layout.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

namespace {

using namespace carom;

// FNV-1a.
class Hash {
 public:
  template <class T>
  void add(const T& value) {
    unsigned char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3u;
  }
  unsigned long long value() const { return value_; }

 private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

// Quaternions of this program's own Eigen, as users have them.
Eigen::Quaternionf turned(int i) {
  return {1, 0.25f * static_cast<float>(i % 5), 0.5f - 0.125f * static_cast<float>(i % 3), 0.75f};
}

Shape tetrahedron() {
  const std::vector<Eigen::Vector3f> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::vector<uint32_t>> faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return Hull{*make_hull(points, faces)};
}

Shape valley() {
  const std::vector<Eigen::Vector3f> points = {{-8, -8, 1}, {8, -8, 1}, {-8, 0, 0},
                                               {8, 0, 0},   {-8, 8, 1}, {8, 8, 1}};
  const std::vector<std::array<uint32_t, 3>> triangles = {
      {0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}};
  return Mesh{*make_mesh(points, triangles)};
}

Shape cross() {
  const std::vector<CompoundChild> children = {
      {Box{{1, 0.2f, 0.2f}}, {0, 0, 0}, turned(1)},
      {Capsule{{0, -1, 0}, {0, 1, 0}, 0.2f}, {0.1f, 0, 0}, turned(2)},
      {tetrahedron(), {0, 0, 0.25f}, turned(3)}};
  return Compound{*make_compound(children)};
}

// All numbers are exact, so that this program's own arithmetic rounds nothing.
std::vector<BodyDesc> make_bodies() {
  const Shape shapes[] = {Sphere{0.5f},
                          Box{{0.4f, 0.5f, 0.3f}},
                          Capsule{{0, 0, 0}, {1, 0, 0}, 0.3f},
                          tetrahedron(),
                          cross(),
                          Aabb{{-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1}}};
  std::vector<BodyDesc> bodies;
  bodies.push_back({.shape = valley(), .motion = Motion::fixed});
  for (int i = 0; i < 60; ++i) {
    bodies.push_back(
        {.shape = shapes[i % 6],
         .position = {-3 + 0.75 * (i % 9), -2.5 + 0.875 * (i / 9), 0.25 + 0.0625 * (i % 7)},
         .orientation = turned(i),
         .linear_velocity = {0, 0.5f, -1},
         .angular_velocity = {0.25f, 0, 0},
         .detection = i % 4 == 0 ? Detection::continuous : Detection::discrete});
  }
  return bodies;
}

void print_layout() {
  std::printf("shape %zu, child %zu, body %zu, pose %zu\n", sizeof(Shape), sizeof(CompoundChild),
              sizeof(BodyDesc), sizeof(Pose));
  std::printf("velocity at %zu, user at %zu\n", offsetof(BodyDesc, linear_velocity),
              offsetof(BodyDesc, user));
  std::printf("settings %zu, report %zu, impact %zu\n", sizeof(WorldSettings), sizeof(StepReport),
              sizeof(Impact));
  std::printf("cast hit %zu, nearest hit %zu\n", sizeof(CastHit), sizeof(NearestHit));
  std::printf("view %zu, columns %zu, arrays %zu\n", sizeof(Collidables), sizeof(ResultColumns),
              sizeof(ResultArrays));
  std::printf("reference result %zu, reference frame %zu\n", sizeof(reference::PairResult),
              sizeof(reference::Frame));
}

unsigned long long hash_of_steps() {
  World world({.positions = PositionType::float64,
               .detail = Detail::regions,
               .parallelism = Parallelism::none,
               .contact_distance = 0.0625f,
               .identities = true});
  std::vector<BodyId> ids;
  world.add(make_bodies(), ids);
  Hash hash;
  for (int frame = 0; frame < 8; ++frame) {
    world.step();
    for (const Contact& contact : world.contacts()) hash.add(contact);
    for (const ManifoldPoints& points : world.manifolds()) hash.add(points);
    for (const ContactIdentity& identity : world.identities()) hash.add(identity);
    for (const Impact& impact : world.impacts()) hash.add(impact);
    for (const Event& event : world.events()) hash.add(event);
    for (const BodyId id : ids) {
      if (world.motion(id) == Motion::fixed) continue;
      const Eigen::Quaternionf q = world.orientation(id);
      world.set_orientation(id, Eigen::Quaternionf(q.w(), q.x() + 0.0625f, q.y(), q.z()));
      world.set_position(id, world.position(id) - Eigen::Vector3d(0, 0, 0.015625));
    }
  }
  if (world.contacts().size() < 50) std::printf("too few contacts\n");

  const std::vector<float> origins = {-3, -2, 9, 0, 0, 9, 1, 2, 9, 2, -1, 9};
  const std::vector<float> down = {0, 0, -1, 0, 0, -1, 0.125f, 0, -1, 0, 0.125f, -1};
  const Rays rays(origins.data(), down.data(), 4, 20);
  std::vector<CastHit> hits;
  world.step();
  world.cast(rays.queries(), rays.sweep(), hits, {.hits = CastHits::all});
  std::vector<NearestHit> nearest;
  world.find_nearest(rays.queries(), 20, nearest);
  for (const CastHit& hit : hits) hash.add(hit.toi), hash.add(hit.normal), hash.add(hit.point);
  for (const NearestHit& hit : nearest) hash.add(hit.separation), hash.add(hit.point_body);
  if (hits.size() < 4 || nearest.size() < 4) std::printf("too few hits\n");
  return hash.value();
}

unsigned long long hash_of_reference() {
  const std::vector<BodyDesc> bodies = make_bodies();
  Hash hash;
  for (size_t i = 1; i + 1 < bodies.size(); ++i) {
    const BodyDesc &a = bodies[i], &b = bodies[i + 1];
    const reference::PairResult result =
        reference::collide(a.shape, {a.position, a.orientation}, b.shape,
                           {b.position, b.orientation}, PositionType::float64);
    hash.add(result.separation);
    hash.add(result.normal);
    hash.add(result.arm_a);
  }
  return hash.value();
}

unsigned long long hash_of_hulls() {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 200; ++i) {
    points.emplace_back(static_cast<float>(i % 7), static_cast<float>(i % 11),
                        static_cast<float>(i * i % 13));
  }
  const Result<BuiltHull> hull = build_hull(points);
  const Result<SimplifiedHull> simple = simplify_hull(points, {.most_points = 8});
  if (!hull || !simple) return 0;
  Hash hash;
  for (const Eigen::Vector3f& point : hull->geometry->points()) hash.add(point);
  for (const Eigen::Vector3f& point : simple->geometry->points()) hash.add(point);
  hash.add(simple->error);
  return hash.value();
}

// The library is tested against Eigen's functions as this program compiles them. In a static build
// the linker keeps one copy of each for both; the library's results must not be made of these.
float use_eigen(const Eigen::Vector3f& u, const Eigen::Vector3d& v, const Eigen::Quaternionf& q) {
  const Eigen::Vector3f w = q.toRotationMatrix() * u + u.cross(Eigen::Vector3f(q * u));
  const Eigen::Vector3d x = (v.cross(v.cwiseAbs()) + v * v.dot(w.cast<double>())).normalized();
  return static_cast<float>(x.norm()) + w.normalized().dot(u) + u.squaredNorm();
}

}  // namespace

int main() {
#if defined(__AVX512F__)
  if (!__builtin_cpu_supports("avx512f")) return 77;  // ctest: skipped
#elif defined(__AVX2__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 77;
#endif
  if (!std::isfinite(use_eigen({1, 2, 3}, {1, 2, 3}, {1, 2, 3, 4}))) return 1;
  print_layout();
  std::printf("steps %016llx\n", hash_of_steps());
  std::printf("reference %016llx\n", hash_of_reference());
  std::printf("hulls %016llx\n", hash_of_hulls());
  return 0;
}
