// Bodies and their parts, placed in the frame of a pair.
#pragma once

#include <cstdint>
#include <optional>

#include "carom/shapes/compound_geometry.h"
#include "geometries/part.h"
#include "trees/tree.h"

namespace carom {

// A body, a child of a compound, or a triangle of a surface. It has parts itself, or it is ready to
// test.
struct PlacedPart {
  static constexpr uint32_t kWhole = 0xffffffffu;

  const Part* part;
  Double3 arm{};  // from the body's position to the part's
  Double3 position;
  Row orientation;
  Turn turn;
  uint32_t child = 0;
  uint32_t triangle = kWhole;          // index in the surface; kWhole: not one of a surface
  std::optional<bool> one_sided = {};  // of triangles of surfaces; without it, as they are made
  // The position of a whole body, or of its surface, as it is stored, for proofs; nullptr: as
  // above.
  const Double3* stored = nullptr;

  // Places a whole body.
  PlacedPart(const Part& body, const Double3& at)
      : part(&body), position(at), orientation(body.orientation), turn(body.turn()) {}

  ShapeKind kind() const { return triangle == kWhole ? part->kind : ShapeKind::triangle; }
  bool has_parts() const { return is_composite(kind()); }

  // The part must be a surface, or a triangle of one.
  Surface surface() const { return surface_at(part->kind, part->rows[0]); }
  MeshRules rules() const {
    MeshRules rules = surface().rules();
    rules.one_sided = one_sided.value_or(rules.one_sided);
    return rules;
  }
  const MeshGeometry& mesh() const { return *geometry_at<MeshGeometry>(part->rows[0]); }
  const HeightFieldGeometry& field() const {
    return *geometry_at<HeightFieldGeometry>(part->rows[0]);
  }
  const CompoundGeometry& compound() const { return *geometry_at<CompoundGeometry>(part->rows[0]); }

  // Whether it is a surface with a scale: its searches go through the tree or the cells of the one
  // without, and code for whole trees and whole cells does not serve it.
  bool is_scaled() const { return is_surface(kind()) && surface().is_scaled(); }

  // Only for those that have parts: the parts by their numbers, and the searches of a BoxTree of
  // their boxes. Height fields have no tree, and search their cells.
  PlacedPart item(uint32_t index) const;
  const BoxTree& tree() const {
    return kind() == ShapeKind::mesh ? mesh().tree() : compound().tree();
  }
  bool has_no_items() const;
  double size() const;  // the greatest coordinate of the boxes
  void find_touching(const RoundedBox& box, ItemsFound found) const;
  void find_below(const Double3& normal, double limit, FunctionRef<void(uint32_t)> found) const;
  void find_admitted(FunctionRef<bool(const TreeBox& box)> admits, ItemsFound found) const;
  uint32_t near_item(const TreeBox& box) const;
  uint32_t low_item(const Double3& normal) const;

  // A number that sorts parts by child, then by triangle.
  uint64_t order() const { return uint64_t{child} << 32 | (triangle == kWhole ? 0 : triangle); }
};

// The part of a whole body that has this order().
PlacedPart part_at(const PlacedPart& body, uint64_t order);

// Body `i` of a view, with position zero.
Part body_part(const BodyReader& reader, size_t i);

}  // namespace carom
