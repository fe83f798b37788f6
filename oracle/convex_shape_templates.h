// Definitions of the templates in convex_shape.h, for the files that say for which numbers they are
// compiled.
#pragma once

#include "oracle/convex_shape.h"

namespace carom::oracle {

template <class R>
Rotation<R>::Rotation(const R& x, const R& y, const R& z, const R& w) {
  const R s = 1 / (x * x + y * y + z * z + w * w);
  column[0] = Vec3<R>{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
  column[1] = Vec3<R>{2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
  column[2] = Vec3<R>{2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
  for (Vec3<R>& c : column) c = c * s;
}

template <class R>
Rotation<R>::Rotation(const Vec3<R>& axis, const R& angle) {
  using std::cos, std::sin;
  const R half_sine = sin(angle / 2), s = sin(angle), k = 2 * half_sine * half_sine;
  const Vec3<R> unit[3] = {{R(1), R(0), R(0)}, {R(0), R(1), R(0)}, {R(0), R(0), R(1)}};
  for (size_t i = 0; i < 3; ++i) {
    column[i] = unit[i] + cross(axis, unit[i]) * s + cross(axis, cross(axis, unit[i])) * k;
  }
}

template <class R>
Vec3<R> Rotation<R>::back(const Vec3<R>& v) const {
  return {dot(column[0], v), dot(column[1], v), dot(column[2], v)};
}

template <class R>
Vec3<R> Rotation<R>::operator()(const Vec3<R>& v) const {
  return column[0] * v.x + column[1] * v.y + column[2] * v.z;
}

template <class R>
ConvexFace<R>::ConvexFace(Vec3<R> a, Vec3<R> b, Vec3<R> c) {
  const R ab = length(b - a), bc = length(c - b), ca = length(a - c);
  if (bc > ab && bc >= ca) {
    std::swap(a, c);
  } else if (ca > ab) {
    std::swap(b, c);
  }
  origin = a;
  u = normalized(b - a);
  normal = common_normal(u, normalized(c - a));
  v = cross(normal, u);
  base = length(b - a);
  apex_x = dot(c - a, u);
  height = dot(c - a, v);
}

template <class R>
ConvexShape<R>::ConvexShape(const Shape& shape) {
  std::visit([this](const auto& s) { this->build(s); }, shape);
  for (const Vec& p : points) bounding_radius = std::max<R>(bounding_radius, length(p));
  bounding_radius += radius;
}

template <class R>
ConvexShape<R>::ConvexShape(const Shape& shape, const Pose& pose,
                            const Eigen::Vector3d& relative_to)
    : ConvexShape(shape) {
  if (!std::holds_alternative<Sphere>(shape) && !std::holds_alternative<Aabb>(shape)) {
    rotate(Rotation<R>(pose.orientation));
  }
  translate(vec3_as<R>(pose.position) - vec3_as<R>(relative_to));
}

template <class R>
R ConvexShape<R>::support(const Vec& n) const {
  R best = dot(points[0], n);
  for (const Vec& p : points) best = std::max<R>(best, dot(p, n));
  return best + radius;
}

template <class R>
Vec3<R> ConvexShape<R>::centroid() const {
  if (is_halfspace) return normal * offset;
  Vec sum;
  for (const Vec& p : points) sum = sum + p;
  return sum * (1 / R(points.size()));
}

template <class R>
void ConvexShape<R>::translate(const Vec& by) {
  for (Vec& p : points) p = p + by;
  for (auto& edge : edges) edge.start = edge.start + by;
  for (auto& face : faces) face.origin = face.origin + by;
  offset += dot(normal, by);
}

template <class R>
void ConvexShape<R>::rotate(const Rotation<R>& rotation) {
  const auto turn = [&](Vec& v) { v = rotation(v); };
  std::for_each(points.begin(), points.end(), turn);
  std::for_each(directions.begin(), directions.end(), turn);
  std::for_each(normals.begin(), normals.end(), turn);
  for (auto& edge : edges) {
    for (Vec* v : {&edge.start, &edge.direction}) turn(*v);
  }
  for (auto& face : faces) {
    for (Vec* v : {&face.origin, &face.u, &face.v, &face.normal}) turn(*v);
  }
  turn(normal);
}

template <class R>
void ConvexShape<R>::build(const Sphere& sphere) {
  points = {Vec{}};
  radius = R(sphere.radius);
}

template <class R>
void ConvexShape<R>::build(const Capsule& capsule) {
  points = {vec3_as<R>(capsule.a), vec3_as<R>(capsule.b)};
  radius = R(capsule.radius);
  add_edge(0, 1);
  directions = {edges[0].direction};
}

template <class R>
void ConvexShape<R>::build_box(const Vec& lower, const Vec& upper) {
  for (int i = 0; i < 8; ++i) {
    points.push_back(
        {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
  }
  directions = {{R(1), R(0), R(0)}, {R(0), R(1), R(0)}, {R(0), R(0), R(1)}};
  normals = directions;
  for (int k = 0; k < 3; ++k) {
    const size_t along = 1u << k, next = 1u << (k + 1) % 3, last = 1u << (k + 2) % 3;
    for (size_t corner : {size_t{0}, next, last, next | last}) add_edge(corner, corner | along);
    for (size_t corner : {size_t{0}, along}) {
      add_quad(corner, corner | next, corner | next | last, corner | last);
    }
  }
}

template <class R>
void ConvexShape<R>::build(const Triangle& triangle) {
  for (const Eigen::Vector3f& corner : triangle.corners) points.push_back(vec3_as<R>(corner));
  for (size_t i = 0; i < 3; ++i) add_edge(i, (i + 1) % 3);
  for (const auto& edge : edges) directions.push_back(edge.direction);
  add_face(0, 1, 2);
  const Vec front = front_normal();
  if (!(dot(front, front) > 0)) return;
  normals.push_back(front);
  for (const auto& edge : edges) {
    normals.push_back(normalized(across(cross(front, edge.direction), edge.direction)));
  }
  if (triangle.thickness > 0) extrude(front * -R(triangle.thickness), front);
}

template <class R>
Vec3<R> ConvexShape<R>::front_normal() const {
  const Vec n = faces[0].normal;
  return dot(n, cross(points[1] - points[0], points[2] - points[0])) < 0 ? -n : n;
}

template <class R>
void ConvexShape<R>::extrude(const Vec& depth, const Vec& front) {
  for (size_t i = 0; i < 3; ++i) points.push_back(points[i] + depth);
  add_face(3, 4, 5);
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3;
    add_edge(i + 3, j + 3);
    add_edge(i, i + 3);
    add_quad(i, j, j + 3, i + 3);
  }
  directions.push_back(front);
}

template <class R>
void ConvexShape<R>::build(const Dop& dop) {
  const ConvexDop<R> polytope(dop);
  points = polytope.points();
  normals = polytope.normals();
  for (const auto& edge : polytope.edges()) {
    edges.emplace_back(edge.from, edge.to);
    const Vec& way = edges.back().direction;
    const bool is_known = std::any_of(directions.begin(), directions.end(), [&](const Vec& u) {
      const Vec n = cross(u, way);
      return dot(n, n) < R(1e-20);
    });
    if (!is_known) directions.push_back(way);
  }
  for (const std::vector<Vec>& face : polytope.faces()) {
    for (size_t i = 2; i < face.size(); ++i) faces.emplace_back(face[0], face[i - 1], face[i]);
  }
}

template <class R>
void ConvexShape<R>::build(const Hull& hull) {
  const auto all = hull.geometry->points();
  const auto known = faces_of(hull.geometry);
  const HullFaces& found = *known;
  std::vector<size_t> place(all.size());
  for (const uint32_t corner : found.corners()) {
    place[corner] = points.size();
    points.push_back(vec3_as<R>(all[corner]));
  }
  radius = hull.rounding;
  is_solid = found.dimension() == 3;
  if (found.dimension() == 1) add_outline({0, 1});
  for (const HullFaces::Outline& outline : found.faces()) {
    std::vector<size_t> corners;
    for (const uint32_t corner : outline) corners.push_back(place[corner]);
    add_outline(corners);
    if (is_solid || faces.empty()) add_polygon(corners);
  }
  if (found.dimension() != 2) return;
  for (const auto& edge : edges) normals.push_back(cross(normals[0], edge.direction));
}

template <class R>
void ConvexShape<R>::add_outline(const std::vector<size_t>& corners) {
  for (size_t i = 0; i < corners.size(); ++i) {
    const size_t from = corners[i], to = corners[(i + 1) % corners.size()];
    if (from >= to) continue;
    add_edge(from, to);
    add_direction(points[to] - points[from]);
  }
}

template <class R>
void ConvexShape<R>::add_direction(const Vec& way) {
  const bool is_known = std::any_of(ways_.begin(), ways_.end(), [&](const Vec& known) {
    const Vec n = cross(known, way);
    return dot(n, n) == 0;
  });
  if (is_known) return;
  ways_.push_back(way);
  directions.push_back(normalized(way));
}

template <class R>
void ConvexShape<R>::add_polygon(const std::vector<size_t>& corners) {
  const Vec& origin = points[corners[0]];
  Vec widest;
  for (size_t i = 2; i < corners.size(); ++i) {
    add_face(corners[0], corners[i - 1], corners[i]);
    for (size_t j = 1; j < i; ++j) {
      const Vec n = cross(points[corners[j]] - origin, points[corners[i]] - origin);
      if (dot(n, n) > dot(widest, widest)) widest = n;
    }
  }
  normals.push_back(normalized(widest));
}

template <class R>
void ConvexShape<R>::build(const Halfspace& halfspace) {
  is_halfspace = true;
  const Vec n = vec3_as<R>(halfspace.normal);
  normal = normalized(n);
  offset = R(halfspace.offset) / length(n);
  bounding_radius = offset < 0 ? -offset : offset;
}

template <class R>
void ConvexShape<R>::add_face(size_t i, size_t j, size_t k) {
  faces.emplace_back(points[i], points[j], points[k]);
}

template <class R>
void ConvexShape<R>::add_quad(size_t i, size_t j, size_t k, size_t l) {
  add_face(i, j, k);
  add_face(i, k, l);
}

}  // namespace carom::oracle
