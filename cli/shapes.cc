#include "cli/shapes.h"

#include <array>

#include "io/file.h"

namespace carom::cli {
namespace {

Error no_kernel(const std::string& source, size_t index, ShapeKind kind) {
  std::string kind_name = name(kind);
  const char* article = kind_name.front() == 'a' ? "an " : "a ";
  return io::file_error(source, "shape_kind: shape " + std::to_string(index) + " is " + article +
                                    kind_name + ", which this version has no kernel for");
}

}  // namespace

Result<std::vector<Shape>> convert_shapes(const io::SceneShapes& shapes,
                                          const std::string& source) {
  std::vector<Shape> converted(shapes.kind.size());
  for (size_t i = 0; i < converted.size(); ++i) {
    const std::array<float, 8>& params = shapes.params[i];
    auto kind = static_cast<ShapeKind>(shapes.kind[i]);
    if (kind == ShapeKind::sphere) {
      converted[i] = Sphere{params[0]};
    } else if (kind == ShapeKind::aabb) {
      converted[i] = Aabb::from_half_extents({params[0], params[1], params[2]});
    } else {
      return no_kernel(source, i, kind);
    }
  }
  return converted;
}

}  // namespace carom::cli
