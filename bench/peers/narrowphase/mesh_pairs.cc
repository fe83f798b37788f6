#include "bench/peers/narrowphase/mesh_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/peers/narrowphase/peer_bodies.h"
#include "bench/support/pair_stream.h"
#include "carom/narrowphase/collide.h"
#include "carom/shapes/mesh_geometry.h"
#include "carom/simd/isa.h"

namespace carom::bench {
namespace {

constexpr int kSquares = 29;  // along an edge of the cube: 12 * 29 * 29 triangles
// Distances of the centres of two balls, whose radius is about 1.
constexpr double kNearest = 1.96, kFarthest = 2.03;

// The point of the ball in a direction.
Eigen::Vector3f on_ball(const Eigen::Vector3f& way) {
  const Eigen::Vector3f n = way.normalized();
  const float bump = std::sin(6 * n.x()) * std::sin(6 * n.y()) * std::sin(6 * n.z());
  return (1 + 0.02F * bump) * n;
}

// A cube of squares, two triangles each, blown up.
std::shared_ptr<const MeshGeometry> make_ball() {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  constexpr uint32_t kRow = kSquares + 1;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const int side = face % 2 == 0 ? -1 : 1;
    const auto first = static_cast<uint32_t>(vertices.size());
    for (int i = 0; i <= kSquares; ++i) {
      for (int j = 0; j <= kSquares; ++j) {
        Eigen::Vector3f corner;
        corner[axis] = static_cast<float>(side * kSquares);
        corner[(axis + 1) % 3] = static_cast<float>(2 * i - kSquares);
        corner[(axis + 2) % 3] = static_cast<float>(side * (2 * j - kSquares));
        vertices.push_back(on_ball(corner));
        if (i == kSquares || j == kSquares) continue;
        const uint32_t here = first + static_cast<uint32_t>(i) * kRow + static_cast<uint32_t>(j);
        triangles.push_back({here, here + kRow, here + kRow + 1});
        triangles.push_back({here, here + kRow + 1, here + 1});
      }
    }
  }
  return *make_mesh(vertices, triangles);
}

Eigen::Quaternionf draw_turn(oracle::Random& random) {
  const double angle = random.uniform(0, std::numbers::pi);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, random.direction())).cast<float>();
}

std::vector<char> bytes_of(const ResultArrays& results) {
  std::vector<char> bytes;
  for_each_column(
      [&]<class T>(const ColumnInfo&, T* column) {
        if (!column) return;
        const char* const begin = reinterpret_cast<const char*>(column);
        bytes.insert(bytes.end(), begin, begin + results.count() * sizeof(T));
      },
      results.columns());
  return bytes;
}

}  // namespace

MeshPairs::MeshPairs(const Spec& spec) : spec_(spec), ball_(make_ball()) {
  oracle::Random random(3);
  // Draws some pairs at a time and keeps as many that touch as others.
  std::array<size_t, 2> left = {spec.count - spec.count / 2, spec.count / 2};
  while (left[0] + left[1] > 0) draw_some(random, left);
  a_ = std::make_unique<DenseBodies>(ShapeKind::mesh, bodies_a_, Storage::f32);
  b_ = std::make_unique<DenseBodies>(ShapeKind::mesh, bodies_b_, Storage::f32);
  ResultArrays results(spec.count, Detail::contact);
  (void)run(Detail::contact, results.columns());
  for (size_t i = 0; i < spec.count; ++i) {
    truths_.push_back({results.columns().separation[i], mean_radius(bodies_a_[i], bodies_b_[i])});
  }
}

void MeshPairs::draw_some(oracle::Random& random, std::array<size_t, 2>& left) {
  constexpr size_t kSome = 100;
  std::vector<PlacedShape> a, b;
  for (size_t i = 0; i < kSome; ++i) {
    PlacedShape body = {Mesh{ball_}, 100 * random.uniform(0, 1) * random.direction()};
    body.orientation = draw_turn(random);
    a.push_back(as_stored(body, Storage::f32));
    body.position += random.uniform(kNearest, kFarthest) * random.direction();
    body.orientation = draw_turn(random);
    b.push_back(as_stored(body, Storage::f32));
  }
  const DenseBodies all_a(ShapeKind::mesh, a, Storage::f32),
      all_b(ShapeKind::mesh, b, Storage::f32);
  std::array<uint8_t, kSome> overlaps;
  ResultColumns out;
  out.overlap = overlaps.data();
  (void)collide_rows(all_a.view(), all_b.view(), Detail::overlap, out);
  for (size_t i = 0; i < kSome; ++i) {
    if (left[overlaps[i]] == 0) continue;
    --left[overlaps[i]];
    bodies_a_.push_back(a[i]);
    bodies_b_.push_back(b[i]);
  }
}

Result<void> MeshPairs::run(Detail detail, const ResultColumns& out, Measured measured) const {
  return collide_rows(a_->view(), b_->view(), detail, out, {.measured = measured});
}

std::string MeshPairs::difference(Detail detail) const {
  ResultArrays results(spec_.count, Detail::manifold);
  std::vector<char> first;
  for (const Isa isa : usable_isas()) {
    force_isa(isa);
    spoil(results);
    if (const Result<void> done = run(detail, results.columns()); !done)
      return done.error().message;
    const std::vector<char> bytes = bytes_of(results);
    if (first.empty()) first = bytes;
    if (bytes != first) return std::string(name(isa)) + ": differs from the scalar form";
  }
  return "";
}

PeerBodies MeshPairs::peer_meshes(const std::vector<PlacedShape>& bodies) const {
  return bench::peer_meshes(ball_->vertices(), ball_->triangles(), bodies);
}

}  // namespace carom::bench
