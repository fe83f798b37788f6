#include "bench/support/mesh_stream.h"

#include <algorithm>
#include <cmath>

#include "bench/support/bodies.h"
#include "bench/support/measure.h"
#include "carom/narrowphase/collide.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"

namespace carom::bench {
namespace {

constexpr size_t kCompared = 50;
constexpr float kHalfTerrain = Terrain::kSide * Terrain::kSquares / 2;  // metres from the origin

float height(float x, float y) { return std::sin(0.35f * x) * std::cos(0.25f * y); }

HeightGrid grid_of(const std::vector<float>& heights) {
  return {.nx = Terrain::kSquares + 1,
          .ny = Terrain::kSquares + 1,
          .dx = Terrain::kSide,
          .dy = Terrain::kSide,
          .samples = {.data = heights.data()}};
}

Terrain make_terrain() {
  constexpr uint32_t kRow = Terrain::kSquares + 1;
  Terrain terrain;
  const auto place = [](uint32_t i) {
    return static_cast<float>((i - Terrain::kSquares / 2.0) * double{Terrain::kSide});
  };
  for (uint32_t j = 0; j < kRow; ++j) {
    for (uint32_t i = 0; i < kRow; ++i) terrain.heights.push_back(height(place(i), place(j)));
  }
  const auto field = *make_height_field(grid_of(terrain.heights));
  for (uint32_t j = 0; j < kRow; ++j) {
    for (uint32_t i = 0; i < kRow; ++i) terrain.vertices.push_back(field->point(i, j));
  }
  for (uint32_t triangle = 0; triangle < field->triangle_count(); ++triangle) {
    terrain.triangles.push_back(field->corner_numbers(triangle));
  }
  return terrain;
}

Shape ground_of(const Terrain& terrain, bool is_field) {
  if (is_field) return HeightField{*make_height_field(grid_of(terrain.heights))};
  return Mesh{*make_mesh(terrain.vertices, terrain.triangles)};
}

// A body over the terrain, up to twice as high as it would touch on flat ground.
PlacedShape draw_above(const MeshSpec& spec, std::span<const Hull> hulls, oracle::Random& random) {
  PlacedShape body = draw_body(spec.kind, random, hulls);
  const Eigen::AlignedBox3d bounds = local_bounds(body);
  const double most = kHalfTerrain - 4;
  const double x = random.uniform(-most, most), y = random.uniform(-most, most);
  const double above = random.uniform(0, 2) * bounds.sizes().z() / 2;
  const float ground = height(static_cast<float>(x), static_cast<float>(y));
  body.position = Eigen::Vector3d(x, y, ground + above) - bounds.center();
  return as_stored(body, Storage::f32);
}

}  // namespace

MeshStream::MeshStream(const MeshSpec& spec) : spec_(spec), terrain_(make_terrain()) {
  ground_.shape = ground_of(terrain_, spec.is_field);
  draw();
  a_ = std::make_unique<DenseBodies>(spec.kind, bodies_, Storage::f32);
  b_ = std::make_unique<DenseBodies>(
      kind_of(ground_.shape), std::vector<PlacedShape>(bodies_.size(), ground_), Storage::f32);
  ResultArrays results(bodies_.size(), Detail::manifold);
  (void)run(Detail::contact, results.columns());
  separations_.assign(results.columns().separation, results.columns().separation + bodies_.size());
  const auto hits = std::count_if(separations_.begin(), separations_.end(),
                                  [](float separation) { return separation <= 0; });
  hit_percent_ = 100.0 * static_cast<double>(hits) / static_cast<double>(bodies_.size());
  ask_reference();
}

// Draws touching and separate bodies in turns.
void MeshStream::draw() {
  oracle::Random random(1);
  const bool has_hulls = spec_.kind == ShapeKind::hull;
  const std::vector<Hull> hulls = draw_hulls(has_hulls ? kHulls : 0, spec_.vertices, random);
  std::array<std::vector<PlacedShape>, 2> drawn;
  while (std::min(drawn[0].size(), drawn[1].size()) < spec_.count / 2 + 1) {
    std::vector<PlacedShape> some;
    for (int i = 0; i < 1000; ++i) some.push_back(draw_above(spec_, hulls, random));
    const std::vector<uint8_t> overlaps = overlaps_of(some);
    for (size_t i = 0; i < some.size(); ++i) drawn[overlaps[i]].push_back(some[i]);
  }
  for (size_t i = 0; i < spec_.count; ++i) bodies_.push_back(drawn[i % 2][i / 2]);
}

std::vector<uint8_t> MeshStream::overlaps_of(const std::vector<PlacedShape>& bodies) const {
  const DenseBodies a(spec_.kind, bodies, Storage::f32);
  const DenseBodies b(kind_of(ground_.shape), std::vector<PlacedShape>(bodies.size(), ground_),
                      Storage::f32);
  std::vector<uint8_t> overlaps(bodies.size());
  ResultColumns out;
  out.overlap = overlaps.data();
  (void)collide_rows(a.view(), b.view(), Detail::overlap, out);
  return overlaps;
}

void MeshStream::ask_reference() {
  const Stopwatch watch;
  for (size_t i = 0; i < std::min(kCompared, bodies_.size()); ++i) {
    expected_.push_back(test::reference_result({bodies_[i], ground_}, PositionType::float32));
  }
  reference_seconds_ =
      watch.seconds() * static_cast<double>(bodies_.size()) / static_cast<double>(expected_.size());
}

Result<void> MeshStream::run(Detail detail, const ResultColumns& out, Measured measured) const {
  return collide_rows(a_->view(), b_->view(), detail, out, {.measured = measured});
}

std::optional<std::string> MeshStream::difference(Detail detail, const ResultColumns& out) const {
  for (size_t row = 0; row < expected_.size(); ++row) {
    if (!has_bits_of(expected_[row], bodies_[row], ground_, detail, out, row)) {
      return "row " + std::to_string(row) + " differs from the reference";
    }
  }
  return std::nullopt;
}

}  // namespace carom::bench
