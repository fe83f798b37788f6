#include "tests/support/height_fields.h"

namespace carom::test {

HeightTable random_heights(uint32_t nx, uint32_t ny, double bumps, double holes,
                           oracle::Random& random) {
  HeightTable table{.nx = nx, .ny = ny};
  for (size_t i = 0; i < size_t{nx} * ny; ++i) {
    const auto height = static_cast<float>(random.uniform(-bumps, bumps));
    table.heights.push_back(random.chance(holes) ? std::numeric_limits<float>::quiet_NaN()
                                                 : height);
  }
  return table;
}

std::shared_ptr<HeightFieldGeometry> geometry_of(const HeightTable& table) {
  return *make_height_field(table.grid());
}

Mesh mesh_like(const HeightFieldGeometry& field) {
  std::vector<bool> is_used(size_t{field.nx()} * field.ny());
  Triangles triangles;
  for (uint32_t triangle = 0; triangle < field.triangle_count(); ++triangle) {
    const uint32_t cell = triangle / 2;
    const std::array<uint32_t, 3> corners = field.corner_numbers(triangle);
    if (field.is_hole(cell % field.cells_x(), cell / field.cells_x())) {
      const uint32_t corner = corners[triangle % 2 == 0 ? 0 : 1];
      triangles.push_back({corner, corner, corner});
    } else {
      triangles.push_back(corners);
      for (const uint32_t corner : corners) is_used[corner] = true;
    }
  }
  std::vector<Eigen::Vector3f> vertices;
  for (uint32_t j = 0; j < field.ny(); ++j) {
    for (uint32_t i = 0; i < field.nx(); ++i) {
      Eigen::Vector3f vertex = field.point(i, j).cwiseProduct(field.scale());
      if (!is_used[vertices.size()]) vertex.z() = field.lower().z();
      vertices.push_back(vertex);
    }
  }
  return mesh_of(vertices, triangles);
}

}  // namespace carom::test
