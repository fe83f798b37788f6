// The specification of a generated scene, as written on the command line: KIND[:key=value,...].
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "carom/base/result.h"
#include "carom/shapes/shape.h"
#include "carom/shapes/views.h"

namespace carom::io {

enum class GeneratorKind : uint8_t {
  brownian,  // cubes of one size, moving freely
  varied,    // cubes of sizes over 2.5 decades, moving freely
  level,     // "static": nine of ten boxes never move
  still,     // brownian without motion
  bullets,   // small fast bodies of several kinds in a room of thin obstacles
};

// Their number has no factor in common with 10, the stride of bodies that move in `level`.
inline constexpr std::array kMixedShapes = {
    ShapeKind::sphere, ShapeKind::box,      ShapeKind::capsule,
    ShapeKind::hull,   ShapeKind::cylinder, ShapeKind::mesh,
    ShapeKind::cone,   ShapeKind::compound, ShapeKind::ellipsoid};

struct GeneratorSpec {
  std::string text;  // as given
  GeneratorKind kind = GeneratorKind::brownian;
  uint64_t bodies = 10000;  // bullets: only the moving ones
  uint64_t frames = 60;
  uint64_t seed = 1;
  std::optional<double> density;  // sum of volumes / world volume; static: bodies a square metre
  std::optional<double> speed;    // the greatest, metres a second
  double dt = 1.0 / 30.0;
  ShapeKind shape = ShapeKind::aabb;  // of all bodies, unless `mixed`
  bool mixed = false;                 // bodies have the kinds of kMixedShapes in turn
  std::optional<double> spin;         // the greatest, radians a second; shapes that turn only
  double rounding = 0;                // metres, of shapes that may have one
  bool float64_positions = false;
  bool mark_static = false;  // static: bodies that never move are static bodies

  bool has_orientation() const {
    return kind == GeneratorKind::bullets || mixed || row_count(shape) > 0;
  }
  ShapeKind shape_of(uint64_t body) const {
    return mixed ? kMixedShapes[body % kMixedShapes.size()] : shape;
  }
};

// The kinds, "brownian, varied, static, still, bullets".
extern const char kGeneratorKinds[];

// Whether the text names a generator, not a file: one word, then the end or ':'.
bool is_generator_text(const std::string& text);

Result<GeneratorSpec> parse_generator(const std::string& text);

// Kinds and keys for the program's help.
extern const char kGeneratorHelp[];

}  // namespace carom::io
