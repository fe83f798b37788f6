// Reads any bytes as a mesh or compound and another body. Every instruction set must agree with the
// scalar reference, which uses no trees, and both orders of the bodies must give the same decision.
#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

#include "carom/shapes/scaled.h"
#include "fuzz/check_pair.h"
#include "fuzz/points_input.h"
#include "fuzz/random_shape.h"

namespace {

using namespace carom;
using namespace carom::fuzz;

enum Flag : uint8_t { kFloat64 = 1, kFar = 2, kSameShape = 4 };
enum MeshFlag : uint8_t { kOneSided = 1, kThick = 2, kAnyIndex = 4 };

constexpr size_t kMostTriangles = 24;
constexpr size_t kMostChildren = 6;

// Empty if the numbers do not make a shape.
using MaybeShape = std::optional<Shape>;
using Triangles = std::vector<std::array<uint32_t, 3>>;
using Vertices = std::vector<Eigen::Vector3f>;

// The conditions of make_mesh().
bool is_mesh(const Vertices& vertices, const Triangles& triangles, const MeshRules& rules) {
  const auto is_finite = [](const Eigen::Vector3f& p) { return p.allFinite(); };
  const auto has_corners = [&](const std::array<uint32_t, 3>& triangle) {
    return *std::max_element(triangle.begin(), triangle.end()) < vertices.size();
  };
  return !triangles.empty() && rules.thickness >= 0 &&
         std::all_of(vertices.begin(), vertices.end(), is_finite) &&
         std::all_of(triangles.begin(), triangles.end(), has_corners);
}

// The conditions of make_compound() for valid shapes.
bool is_compound(const std::vector<CompoundChild>& children) {
  return !children.empty() && std::all_of(children.begin(), children.end(), [](const auto& child) {
    return !std::holds_alternative<Halfspace>(child.shape) && child.orientation.norm() > 0;
  });
}

MaybeShape take_mesh(double size, size_t most_triangles, Data& data) {
  const auto flags = take<uint8_t>(data);
  const size_t corners = take<uint8_t>(data) % 16;
  Triangles triangles(take<uint8_t>(data) % (most_triangles + 1));
  const uint32_t indices = flags & kAnyIndex || corners == 0 ? 256 : static_cast<uint32_t>(corners);
  for (auto& triangle : triangles) {
    for (uint32_t& corner : triangle) corner = take<uint8_t>(data) % indices;
  }
  MeshRules rules{.one_sided = (flags & kOneSided) != 0};
  if (flags & kThick) rules.thickness = static_cast<float>(size * take_unit(data));
  const Vertices vertices = CloudReader(size, data).points(corners);
  const auto mesh = make_mesh(vertices, triangles, rules);
  EXPECT_EQ(bool(mesh), is_mesh(vertices, triangles, rules));
  if (!mesh) return std::nullopt;
  return Mesh{*mesh};
}

// Gives a lone triangle its own rules.
void add_rules(Triangle& triangle, uint8_t form) {
  triangle.one_sided = (form & 8) != 0;
  triangle.inner_edges = form >> 5;
}

Shape take_simple(ShapeKind kind, double size, Data& data) {
  const auto form = take<uint8_t>(data);
  Shape shape = take_random_shape(kind, form, size, data);
  if (auto* triangle = std::get_if<Triangle>(&shape)) add_rules(*triangle, form);
  return shape;
}

MaybeShape take_compound(double size, Data& data);

MaybeShape take_shape(ShapeKind kind, double size, size_t most_triangles, Data& data) {
  if (kind == ShapeKind::mesh) return take_mesh(size, most_triangles, data);
  if (kind == ShapeKind::compound) return take_compound(size, data);
  return take_simple(kind, size, data);
}

// Reads children of any kind except compounds. make_compound() must refuse half-spaces.
MaybeShape take_compound(double size, Data& data) {
  std::vector<CompoundChild> children(take<uint8_t>(data) % (kMostChildren + 1));
  for (CompoundChild& child : children) {
    const auto kind = static_cast<ShapeKind>(take<uint8_t>(data) % kShapeKindCount);
    if (kind == ShapeKind::compound) return std::nullopt;
    const MaybeShape shape = take_shape(kind, size / 2, kMostTriangles / 4, data);
    if (!shape) return std::nullopt;
    child.shape = *shape;
    child.position = (take_vector(data) * size).cast<float>();
    child.orientation = take_orientation(data);
  }
  const auto compound = make_compound(children);
  EXPECT_EQ(bool(compound), is_compound(children));
  if (!compound) return std::nullopt;
  return Compound{*compound};
}

// The shape, or one of its kind with a scale.
Shape take_scaled(const Shape& shape, Data& data) {
  const bool is_scaled = take<uint8_t>(data) % 2 != 0;
  if (!is_scaled || !has_geometry(kind_of(shape))) return shape;
  const Result<Shape> result = scaled(shape, (take_vector(data) * 2).cast<float>());
  return result ? *result : shape;
}

std::optional<TestPair> take_pair(const std::array<ShapeKind, 2>& kinds, uint8_t flags,
                                  Data& data) {
  const double size = take_size(data);
  const MaybeShape a = take_shape(kinds[0], size, kMostTriangles, data);
  const bool is_same = (flags & kSameShape) != 0 && kinds[0] == kinds[1];
  const MaybeShape b = is_same ? a : take_shape(kinds[1], size, kMostTriangles, data);
  if (!a || !b) return std::nullopt;
  TestPair pair{{*a}, {*b}};
  if (flags & kFar) pair.a.position = take_vector(data) * 1000 * size;
  pair.b.position = pair.a.position + take_vector(data) * 2 * size;
  pair.a.orientation = take_orientation(data);
  pair.b.orientation = take_orientation(data);
  pair.a.shape = take_scaled(pair.a.shape, data);
  pair.b.shape = take_scaled(pair.b.shape, data);
  return pair;
}

// The number of parts; a result's sub-shape must be below it.
size_t part_count(const Shape& shape) {
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh->geometry->triangles().size();
  if (const auto* all = std::get_if<Compound>(&shape)) return all->geometry->children().size();
  return 1;
}

void check_pair(const TestPair& pair, PositionType positions) {
  SCOPED_TRACE(test::show(pair) + "\n" + test::name(positions));
  const reference::PairResult result = test::reference_result(pair, positions);
  expect_everywhere(pair, positions, result);
  if (result.status == Status::invalid) return;
  expect_numbers(pair, result);
  EXPECT_LT(result.sub_a, part_count(pair.a.shape));
  EXPECT_LT(result.sub_b, part_count(pair.b.shape));
  EXPECT_EQ(result.overlap, test::reference_result(test::swapped(pair), positions).overlap);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  static const auto kKinds = test::composite_kind_pairs();
  Data data(bytes, size);
  const auto& kinds = kKinds[take<uint8_t>(data) % kKinds.size()];
  const auto flags = take<uint8_t>(data);
  const auto positions = flags & kFloat64 ? PositionType::float64 : PositionType::float32;
  if (const auto pair = take_pair(kinds, flags, data)) check_pair(*pair, positions);
  abort_on_failure();
  return 0;
}
