#include "cli/page/shape_view.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "geometries/surface.h"
#include "shapes/dop_polytope.h"

namespace carom::cli {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const Eigen::Vector3f& v) {
  return {shortest(v.x()), shortest(v.y()), shortest(v.z())};
}

Json numbers(const Eigen::Quaternionf& q) {
  return {shortest(q.x()), shortest(q.y()), shortest(q.z()), shortest(q.w())};
}

// Collects corners and outlines of faces.
class Faces {
 public:
  size_t add_point(double x, double y, double z) {
    for (const double coordinate : {x, y, z}) points_.push_back(coordinate);
    return points_.size() / 3 - 1;
  }
  size_t add_point(const Eigen::Vector3f& p) {
    return add_point(shortest(p.x()), shortest(p.y()), shortest(p.z()));
  }
  void add_face(Json outline) { faces_.push_back(std::move(outline)); }

  // Adds a thick triangle, which extends behind its front by the thickness.
  void add_prism(const std::array<Eigen::Vector3f, 3>& corners, float thickness) {
    std::array<size_t, 3> front{}, back{};
    const Eigen::Vector3d depth = double{thickness} * front_normal(corners);
    for (size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d behind = corners[i].cast<double>() - depth;
      front[i] = add_point(corners[i]);
      back[i] = add_point(behind.x(), behind.y(), behind.z());
    }
    add_face(front);
    add_face({back[0], back[2], back[1]});
    for (size_t i = 0; i < 3; ++i) {
      const size_t next = (i + 1) % 3;
      add_face({front[next], front[i], back[i], back[next]});
    }
  }

  // Adds a ring of points about the z axis, counter-clockwise from above; the place of the first.
  size_t add_ring(double radius_x, double radius_y, double z) {
    const size_t first = points_.size() / 3;
    for (size_t k = 0; k < kOfRing; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / kOfRing;
      add_point(radius_x * std::cos(angle), radius_y * std::sin(angle), z);
    }
    return first;
  }
  // The faces between two rings, the second above the first.
  void join_rings(size_t lower, size_t upper) {
    for (size_t k = 0; k < kOfRing; ++k) {
      const size_t next = (k + 1) % kOfRing;
      add_face({lower + k, lower + next, upper + next, upper + k});
    }
  }
  void close_ring(size_t ring, bool from_above) {
    Json outline = Json::array();
    for (size_t k = 0; k < kOfRing; ++k) {
      outline.push_back(ring + (from_above ? k : kOfRing - 1 - k));
    }
    add_face(std::move(outline));
  }

  // Moves every face outwards by the rounding, and closes the gaps along edges and at corners with
  // flat faces: a picture of all points within the rounding. Nothing without faces.
  void grow(double rounding) {
    if (!(rounding > 0) || faces_.empty()) return;
    const auto old_points = std::exchange(points_, Json::array());
    const auto old_faces = std::exchange(faces_, Json::array());
    const auto old_point = [&](size_t i) -> Eigen::Vector3d {
      const auto at = [&](size_t k) { return old_points[3 * i + k].get<double>(); };
      return {at(0), at(1), at(2)};
    };
    const std::vector<size_t> same = first_of_same_points(old_points);
    // By the old numbers of its ends, the new ones of an edge.
    std::map<std::pair<size_t, size_t>, std::pair<size_t, size_t>> edges;
    for (const Json& face : old_faces) {
      std::vector<size_t> corners;
      for (const Json& corner : face) corners.push_back(same[corner.get<size_t>()]);
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      for (size_t k = 0; k < corners.size(); ++k) {
        const size_t next = (k + 1) % corners.size();
        normal += old_point(corners[k]).cross(old_point(corners[next]));
      }
      if (!(normal.norm() > 0)) continue;
      std::vector<size_t> outline;
      for (const size_t corner : corners) {
        const Eigen::Vector3d p = old_point(corner) + normal.normalized() * rounding;
        outline.push_back(add_point(p.x(), p.y(), p.z()));
      }
      for (size_t k = 0; k < corners.size(); ++k) {
        const size_t next = (k + 1) % corners.size();
        edges[{corners[k], corners[next]}] = {outline[k], outline[next]};
      }
      add_face(outline);
    }
    // The new points of a corner, from each to the next one around it.
    std::map<size_t, std::map<size_t, size_t>> around;
    for (const auto& [old_ends, ends] : edges) {
      const auto other = edges.find({old_ends.second, old_ends.first});
      if (other == edges.end()) continue;
      const auto [to_end, to_start] = other->second;
      if (old_ends.first < old_ends.second) {
        add_face({ends.second, ends.first, to_start, to_end});
      }
      around[old_ends.first][ends.first] = to_start;
    }
    for (const auto& [corner, next] : around) close_corner(next);
  }

  Json json() && { return {{"points", std::move(points_)}, {"faces", std::move(faces_)}}; }

 private:
  static constexpr size_t kOfRing = 24;

  // Rings of radius 0 are one point.
  static std::vector<size_t> first_of_same_points(const Json& points) {
    constexpr double kParts = 0x1p30;
    double greatest = 0;
    for (const Json& x : points) greatest = std::max(greatest, std::fabs(x.get<double>()));
    std::map<std::array<long long, 3>, size_t> known;
    std::vector<size_t> first(points.size() / 3);
    for (size_t i = 0; i < first.size(); ++i) {
      std::array<long long, 3> place{};
      for (size_t k = 0; k < 3 && greatest > 0; ++k) {
        place[k] = std::llround(points[3 * i + k].get<double>() / greatest * kParts);
      }
      first[i] = known.try_emplace(place, i).first->second;
    }
    return first;
  }

  // Adds the face whose points follow one another like this, if they come back to the first.
  void close_corner(const std::map<size_t, size_t>& next) {
    Json outline = Json::array();
    size_t at = next.begin()->first;
    do {
      outline.insert(outline.begin(), at);
      const auto step = next.find(at);
      if (step == next.end()) return;
      at = step->second;
    } while (at != next.begin()->first && outline.size() <= next.size());
    if (outline.size() > 2) add_face(std::move(outline));
  }

  static Eigen::Vector3d front_normal(const std::array<Eigen::Vector3f, 3>& corners) {
    const Eigen::Vector3d a = corners[0].cast<double>();
    return (corners[1].cast<double>() - a).cross(corners[2].cast<double>() - a).normalized();
  }

  Json points_ = Json::array();
  Json faces_ = Json::array();
};

// The JSON view of each shape, without its kind.
struct Viewer {
  ShapeTable& shapes;

  Json operator()(const Sphere& sphere) const { return {{"radius", shortest(sphere.radius)}}; }

  Json operator()(const Capsule& capsule) const {
    return {
        {"a", numbers(capsule.a)}, {"b", numbers(capsule.b)}, {"radius", shortest(capsule.radius)}};
  }

  Json operator()(const Aabb& box) const {
    return {{"lower", numbers(box.lower)}, {"upper", numbers(box.upper)}};
  }

  Json operator()(const Box& box) const {
    if (box.rounding == 0) return {{"lower", numbers(-box.half)}, {"upper", numbers(box.half)}};
    Faces faces;
    for (int i = 0; i < 8; ++i) {  // bit k of i: at the upper end of axis k
      const auto end = [&](int axis) {
        return i >> axis & 1 ? shortest(box.half[axis]) : -shortest(box.half[axis]);
      };
      faces.add_point(end(0), end(1), end(2));
    }
    for (const auto& face :
         {std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}, std::array{0, 1, 5, 4},
          std::array{2, 6, 7, 3}, std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}}) {
      faces.add_face(face);
    }
    return grown(std::move(faces), box.rounding);
  }

  // With the rounding itself, since the picture's edges are flat.
  static Json grown(Faces faces, float rounding) {
    faces.grow(rounding);
    Json view = std::move(faces).json();
    if (rounding > 0) view["rounding"] = shortest(rounding);
    return view;
  }

  Json operator()(const Halfspace& halfspace) const {
    return {{"normal", numbers(halfspace.normal)}, {"offset", shortest(halfspace.offset)}};
  }

  Json operator()(const Triangle& triangle) const {
    Faces faces;
    if (triangle.thickness > 0) {
      faces.add_prism(triangle.corners, triangle.thickness);
    } else {
      for (const Eigen::Vector3f& corner : triangle.corners) faces.add_point(corner);
      faces.add_face({0, 1, 2});
    }
    return std::move(faces).json();
  }

  Json operator()(const Dop& dop) const {
    const DopPolytope polytope{DopSlabs(dop)};
    Faces faces;
    for (const DopFace& face : polytope.faces()) {
      Json outline = Json::array();
      for (const DopCorner& corner : polytope.corners(face)) {
        const Double3 point = polytope.point(corner.point);
        outline.push_back(faces.add_point(point[0], point[1], point[2]));
      }
      if (outline.size() > 2) faces.add_face(std::move(outline));
    }
    return std::move(faces).json();
  }

  Json operator()(const Cylinder& c) const {
    Faces faces;
    const size_t lower = faces.add_ring(c.radius, c.radius, -c.half_length);
    const size_t upper = faces.add_ring(c.radius, c.radius, c.half_length);
    faces.join_rings(lower, upper);
    faces.close_ring(lower, false);
    faces.close_ring(upper, true);
    return grown(std::move(faces), c.rounding);
  }

  // The ring at the tip has no radius.
  Json operator()(const Cone& c) const {
    Faces faces;
    const size_t base = faces.add_ring(c.radius, c.radius, -c.half_length);
    faces.join_rings(base, faces.add_ring(0, 0, c.half_length));
    faces.close_ring(base, false);
    return grown(std::move(faces), c.rounding);
  }

  Json operator()(const Ellipsoid& e) const {
    constexpr int kRings = 12;
    Faces faces;
    size_t below = 0;
    for (int i = 0; i <= kRings; ++i) {
      const double angle = std::numbers::pi * (double{1} * i / kRings - 0.5);
      const double out = std::cos(angle), up = std::sin(angle);
      const size_t ring =
          faces.add_ring(e.semi_axes.x() * out, e.semi_axes.y() * out, e.semi_axes.z() * up);
      if (i > 0) faces.join_rings(below, ring);
      below = ring;
    }
    return grown(std::move(faces), e.rounding);
  }

  Json operator()(const Hull& hull) const {
    Faces faces;
    for (const Eigen::Vector3f& point : hull.geometry->points()) faces.add_point(point);
    for (const HullGeometry::Face& face : hull.geometry->faces()) {
      const auto corners = hull.geometry->corners(face);
      faces.add_face(Json(std::vector<uint32_t>(corners.begin(), corners.end())));
    }
    return grown(std::move(faces), hull.rounding);
  }

  Json operator()(const Mesh& mesh) const {
    const MeshGeometry& geometry = *mesh.geometry;
    const float thickness = geometry.rules().thickness;
    Faces faces;
    if (!(thickness > 0)) {
      for (size_t i = 0; i < geometry.vertices().size(); ++i) faces.add_point(geometry.vertex(i));
    }
    for (size_t i = 0; i < geometry.triangles().size(); ++i) {
      if (thickness > 0) {
        faces.add_prism(geometry.corners(i), thickness);
      } else {
        faces.add_face(geometry.corner_numbers(i));
      }
    }
    return std::move(faces).json();
  }

  // Holes have points, but no faces.
  Json operator()(const HeightField& field) const {
    const HeightFieldGeometry& grid = *field.geometry;
    Faces faces;
    for (uint32_t j = 0; j < grid.ny(); ++j) {
      for (uint32_t i = 0; i < grid.nx(); ++i) {
        const Eigen::Vector3f point = grid.point(i, j).cwiseProduct(grid.scale());
        faces.add_point(point.allFinite() ? point : Eigen::Vector3f(point.x(), point.y(), 0));
      }
    }
    for_each_triangle(grid, [&](size_t i) { faces.add_face(grid.corner_numbers(i)); });
    return std::move(faces).json();
  }

  Json operator()(const Compound& compound) const {
    Json children = Json::array();
    for (const CompoundChild& child : compound.geometry->children()) {
      children.push_back({{"shape", shapes.add(child.shape)},
                          {"position", numbers(child.position)},
                          {"orientation", numbers(child.orientation)}});
    }
    return {{"children", std::move(children)}};
  }
};

}  // namespace

double shortest(float value) {
  std::array<char, 32> text;
  const char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double number = 0;
  std::from_chars(text.data(), end, number);
  return number;
}

Json view_of(const Shape& shape, ShapeTable& shapes) {
  Json view = {{"kind", name(kind_of(shape))}};
  view.update(std::visit(Viewer{shapes}, shape));
  return view;
}

}  // namespace carom::cli
