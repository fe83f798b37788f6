#include "io/generate/made_shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace carom::io {
namespace {

// A triangulated unit sphere: an octahedron whose triangles are each split into four.
struct Surface {
  std::vector<Vec3> corners;  // unit vectors
  std::vector<std::array<uint32_t, 3>> triangles;
};

Vec3 scaled(const Vec3& v, double length) {
  const double norm = std::sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
  return {v[0] * length / norm, v[1] * length / norm, v[2] * length / norm};
}

Surface cut_octahedron() {
  Surface surface;
  surface.corners = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [place, is_new] = middles.emplace(std::minmax(a, b), surface.corners.size());
    if (is_new) {
      const Vec3 &u = surface.corners[a], &v = surface.corners[b];
      surface.corners.push_back(scaled({u[0] + v[0], u[1] + v[1], u[2] + v[2]}, 1));
    }
    return place->second;
  };
  for (uint32_t octant = 0; octant < 8; ++octant) {
    uint32_t a = octant & 1 ? 3 : 0, b = octant & 2 ? 4 : 1;
    const uint32_t c = octant & 4 ? 5 : 2;
    const bool is_mirrored = ((octant & 1) + (octant >> 1 & 1) + (octant >> 2)) % 2 != 0;
    if (is_mirrored) std::swap(a, b);
    const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    surface.triangles.insert(surface.triangles.end(),
                             {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return surface;
}

class ShapeMaker {
 public:
  ShapeMaker(double diameter, Random& random, SceneShapes& shapes)
      : radius_(diameter / 2), random_(random), shapes_(shapes) {}

  void make_hull(size_t index) {
    begin_vertices(index);
    const uint64_t count = 8 + random_.below(17);
    for (uint64_t i = 0; i < count; ++i) add_vertex(direction(), radius_);
    end_vertices(index);
  }

  void make_mesh(size_t index) {
    static const Surface surface = cut_octahedron();
    begin_vertices(index);
    for (const Vec3& corner : surface.corners) {
      add_vertex(corner, random_.below(2) ? radius_ : radius_ * random_.between(0.4, 0.8));
    }
    end_vertices(index);
    shapes_.triangle_range[index] = {static_cast<uint32_t>(shapes_.triangles.size()),
                                     static_cast<uint32_t>(surface.triangles.size())};
    shapes_.triangles.insert(shapes_.triangles.end(), surface.triangles.begin(),
                             surface.triangles.end());
  }

  void make_compound(size_t index) {
    shapes_.child_range[index] = {static_cast<uint32_t>(shapes_.child_shape.size()), 4};
    const auto part = static_cast<float>(radius_ / 4);
    add_child(ShapeKind::sphere, {2 * part});
    add_child(ShapeKind::capsule, {-part, 0, 0, part, 0, 0, part / 2});
    add_child(ShapeKind::box, {part, part / 2, part});
    add_child(ShapeKind::hull, {});
    ShapeMaker(radius_ / 2, random_, shapes_).make_hull(shapes_.kind.size() - 1);
  }

 private:
  Vec3 direction() {
    for (;;) {
      const Vec3 v = random_.in_ball(1);
      if ((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2] > 0x1p-10) return v;
    }
  }

  void begin_vertices(size_t index) {
    shapes_.vertex_range[index][0] = static_cast<uint32_t>(shapes_.vertices.size());
  }
  void add_vertex(const Vec3& way, double length) {
    const Vec3 v = scaled(way, length);
    shapes_.vertices.push_back(
        {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])});
  }
  void end_vertices(size_t index) {
    auto& [first, count] = shapes_.vertex_range[index];
    count = static_cast<uint32_t>(shapes_.vertices.size()) - first;
  }

  // A child's points lie within half the radius of its own origin, and its origin within half the
  // radius of the compound's, so all of it lies in the ball.
  void add_child(ShapeKind kind, const std::array<float, 8>& params) {
    const auto child = static_cast<uint32_t>(shapes_.kind.size());
    resize_shapes(kind, child + 1, shapes_);
    shapes_.params[child] = params;
    shapes_.child_shape.push_back(child);
    const Vec3 at = random_.in_ball(radius_ / 2);
    shapes_.child_position.push_back(
        {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
    const Quaternion turn = random_.rotation();
    shapes_.child_orientation.push_back({static_cast<float>(turn[0]), static_cast<float>(turn[1]),
                                         static_cast<float>(turn[2]), static_cast<float>(turn[3])});
  }

  double radius_;
  Random& random_;
  SceneShapes& shapes_;
};

}  // namespace

void resize_shapes(ShapeKind kind, size_t count, SceneShapes& shapes) {
  shapes.kind.resize(count, static_cast<uint8_t>(kind));
  shapes.params.resize(count);
  shapes.vertex_range.resize(count);
  shapes.triangle_range.resize(count);
  shapes.child_range.resize(count);
}

void make_shape(ShapeKind kind, double diameter, Random& random, size_t index,
                SceneShapes& shapes) {
  ShapeMaker maker(diameter, random, shapes);
  if (kind == ShapeKind::hull) {
    maker.make_hull(index);
  } else if (kind == ShapeKind::mesh) {
    maker.make_mesh(index);
  } else {
    maker.make_compound(index);
  }
}

}  // namespace carom::io
