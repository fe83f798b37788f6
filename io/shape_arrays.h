// The shape arrays that scenes and files of pairs share.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "carom/base/result.h"
#include "carom/shapes/shape.h"
#include "io/files/npz.h"

namespace carom::io {

// The arrays as stored in the file; ranges are (first, count). Absent arrays are empty.
struct SceneShapes {
  std::vector<uint8_t> kind;  // ShapeKind
  std::vector<std::array<float, 8>> params;
  std::vector<std::array<uint32_t, 2>> vertex_range;
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<uint32_t, 2>> triangle_range;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<std::array<uint32_t, 2>> child_range;
  std::vector<uint32_t> child_shape;
  std::vector<std::array<float, 3>> child_position;
  std::vector<std::array<float, 4>> child_orientation;
  std::vector<std::array<uint32_t, 2>> height_range;
  std::vector<float> heights;               // metres, NaN makes holes
  std::vector<float> rounding;              // shape_radius, metres; empty: all are 0
  std::vector<std::array<float, 3>> scale;  // factors of the set that the other arrays describe
};

// Reads the shapes. Checks that kinds are known, ranges and indices lie inside their arrays,
// children are not compounds, height fields have as many heights as their grids have samples,
// scales are finite and not 0, roundings are not negative and are 0 for kinds that have none, and
// each kind has the arrays it needs. Other parameters are not checked.
Result<SceneShapes> read_shapes(const NpzReader& reader);
// The checks alone; `path` is for the message.
Result<void> check_shapes(const SceneShapes& shapes, const std::string& path);
// Whether shapes of this kind may have a rounding.
bool takes_rounding(uint8_t kind);
// Adds shape_kind and shape_params, and every other array that is not empty.
Result<void> write_shapes(const SceneShapes& shapes, NpzWriter& writer);

// carom_version must be 1; it may be absent only if not `required`.
Result<void> check_version(const NpzReader& reader, bool required);
Result<void> write_version(NpzWriter& writer);

}  // namespace carom::io
