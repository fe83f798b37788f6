// Bodies and what they are made of, placed in the frame of a pair.
#pragma once

#include <cstdint>

#include "carom/shapes/compound_geometry.h"
#include "geometries/part.h"
#include "trees/tree.h"

namespace carom {

// A body, a child of a compound, or a triangle of a mesh: one that has parts, or one to test.
struct PlacedPart {
  static constexpr uint32_t kWhole = 0xffffffffu;

  const Part* part;
  Double3 arm{};  // from the body's position to its own
  Double3 position;
  Row orientation;
  Turn turn;
  uint32_t child = 0;
  uint32_t triangle = kWhole;  // of a mesh

  // A whole body.
  PlacedPart(const Part& body, const Double3& at)
      : part(&body), position(at), orientation(body.orientation), turn(body.turn()) {}

  ShapeKind kind() const { return triangle == kWhole ? part->kind : ShapeKind::triangle; }
  bool has_parts() const { return is_composite(kind()); }

  const MeshGeometry& mesh() const { return *geometry_at<MeshGeometry>(part->rows[0]); }
  const CompoundGeometry& compound() const { return *geometry_at<CompoundGeometry>(part->rows[0]); }
  // Of those that have parts.
  const BoxTree& tree() const {
    return kind() == ShapeKind::mesh ? mesh().tree() : compound().tree();
  }
  PlacedPart item(uint32_t index) const;

  // Parts in the order of sub-shapes.
  uint64_t order() const { return uint64_t{child} << 32 | (triangle == kWhole ? 0 : triangle); }
};

// Body `i` of a view.
Part body_part(const BodyReader& reader, size_t i);

}  // namespace carom
