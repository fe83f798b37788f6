#include "cli/verify/exact_decision.h"

#include <algorithm>
#include <array>
#include <variant>
#include <vector>

#include "carom/results/tier.h"
#include "carom/shapes/compound_geometry.h"
#include "geometries/part.h"
#include "geometries/surface.h"
#include "narrowphase/proof/exact_overlap.h"
#include "narrowphase/proof/proof.h"

namespace carom::cli {
namespace {

Double3 numbers(const Position<double>& p) { return {p.x, p.y, p.z}; }
Position<double> position(const Double3& p) { return {p[0], p[1], p[2]}; }

template <class Geometry>
void add_triangles(const Geometry& surface, const StatedBody& body,
                   std::vector<StatedBody>& parts) {
  for_each_triangle(surface, [&](size_t i) {
    std::array<Row, 3> rows;
    put_triangle_rows(surface, i, rows.data());
    parts.push_back(
        {shape_from_rows(ShapeKind::triangle, rows.data()), body.position, body.orientation});
  });
}

Shape shape_of(const Part& child) {
  return child.kind == ShapeKind::sphere ? Shape(Sphere{child.radius})
                                         : shape_from_rows(child.kind, child.rows.data());
}

void add_parts(const StatedBody& body, std::vector<StatedBody>& parts) {
  if (const Mesh* mesh = std::get_if<Mesh>(&body.shape)) {
    add_triangles(*mesh->geometry, body, parts);
  } else if (const HeightField* field = std::get_if<HeightField>(&body.shape)) {
    add_triangles(*field->geometry, body, parts);
  } else if (const Compound* compound = std::get_if<Compound>(&body.shape)) {
    for (const Part& child : compound->geometry->parts()) {
      const PlacedChild at =
          placed(child, numbers(body.position), rotation_of(body.orientation), body.orientation);
      add_parts({shape_of(child), position(at.position), at.orientation}, parts);
    }
  } else {
    parts.push_back(body);
  }
}

std::vector<StatedBody> parts_of(const StatedBody& body) {
  std::vector<StatedBody> parts;
  add_parts(body, parts);
  return parts;
}

uint8_t simple_decision(const StatedBody& a, const StatedBody& b) {
  const uint8_t proven = prove_overlap(a, b);
  const bool has_round = is_round(kind_of(a.shape)) || is_round(kind_of(b.shape));
  return proven == kUndecided && !has_round ? exact_overlap(a, b) : proven;
}

bool is_compound(const StatedBody& body) { return kind_of(body.shape) == ShapeKind::compound; }

}  // namespace

uint8_t exact_decision(const StatedBody& a, const StatedBody& b) {
  if (!is_composite(kind_of(a.shape)) && !is_composite(kind_of(b.shape))) {
    return simple_decision(a, b);
  }
  StatedBody near_a = a, near_b = b;
  if (is_compound(a) ||
      is_compound(b)) {  // children are computed near the origin, relative to the pair
    near_b.position = position(minus(numbers(b.position), numbers(a.position)));
    near_a.position = position({});
  }
  const std::vector<StatedBody> parts_a = parts_of(near_a);
  const std::vector<StatedBody> parts_b = parts_of(near_b);
  uint8_t decision = 0;
  for (const StatedBody& part_a : parts_a) {
    for (const StatedBody& part_b : parts_b) {
      const uint8_t of_parts = simple_decision(part_a, part_b);
      if (of_parts == 1) return 1;
      decision = std::max(decision, of_parts);
    }
  }
  return decision;
}

}  // namespace carom::cli
