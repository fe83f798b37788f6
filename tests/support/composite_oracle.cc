#include "tests/support/composite_oracle.h"

namespace carom::test {

ExactPart::ExactPart(const Shape& of, const Vec& position, const Eigen::Quaternionf& orientation,
                     uint32_t name)
    : shape(of, Pose{Eigen::Vector3d::Zero(), orientation}), sub(name) {
  shape.translate(position);
  const oracle::Rotation<long double> turn(orientation);
  middle = position + turn(middle_of(of));
  centre = shape.centroid();
  lower = upper = centre;
  for (const Vec& p : shape.points) {
    radius = std::max(radius, length(p - centre));
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
  }
  const Vec around{shape.radius, shape.radius, shape.radius};
  lower = lower - around;
  upper = upper + around;
  radius += shape.radius;
}

oracle::Vec3<long double> ExactPart::middle_of(const Shape& of) {
  std::vector<Eigen::Vector3f> points;
  if (const auto* capsule = std::get_if<Capsule>(&of)) points = {capsule->a, capsule->b};
  if (const auto* triangle = std::get_if<Triangle>(&of)) {
    points.assign(triangle->corners.begin(), triangle->corners.end());
  }
  if (const auto* hull = std::get_if<Hull>(&of)) {
    points.assign(hull->geometry->points().begin(), hull->geometry->points().end());
  }
  if (points.empty()) return {};  // spheres and boxes have none
  Eigen::Vector3f low = points[0], high = points[0];
  for (const Eigen::Vector3f& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (oracle::vec3_as<long double>(low) + oracle::vec3_as<Number>(high)) * 0.5L;
}

ExactParts::ExactParts(const PlacedShape& body, const Vec& position) {
  if (const auto* compound = std::get_if<Compound>(&body.shape)) {
    const auto children = compound->geometry->children();
    for (uint32_t i = 0; i < children.size(); ++i) add_child(children[i], body, position, i);
  } else {
    add(body.shape, position, body.orientation, {});
  }
  for (const ExactPart& part : parts_) {
    for (const Vec& p : part.shape.points) {
      bounding_radius_ = std::max(bounding_radius_, length(p - position) + part.shape.radius);
    }
  }
}

void ExactParts::add_child(const CompoundChild& child, const PlacedShape& body, const Vec& position,
                           uint32_t index) {
  const oracle::Rotation<long double> turn(body.orientation);
  Shape shape = child.shape;
  Vec at = oracle::vec3_as<long double>(child.position);
  Eigen::Quaternionf orientation =
      (body.orientation.cast<long double>() * child.orientation.cast<Number>()).cast<float>();
  if (const auto* box = std::get_if<Aabb>(&child.shape)) {
    at = at +
         (oracle::vec3_as<long double>(box->lower) + oracle::vec3_as<Number>(box->upper)) * 0.5L;
    shape = Box{(box->upper - box->lower) / 2};
    orientation = body.orientation;
  }
  add(shape, position + turn(at), orientation, index);
}

void ExactParts::add(const Shape& shape, const Vec& position, const Eigen::Quaternionf& orientation,
                     const std::optional<uint32_t>& child) {
  const auto* mesh = std::get_if<Mesh>(&shape);
  if (!mesh) {
    parts_.emplace_back(shape, position, orientation, child.value_or(0));
    return;
  }
  const InnerEdges inner(*mesh);
  parts_.reserve(parts_.size() + mesh->geometry->triangles().size());
  for (uint32_t i = 0; i < mesh->geometry->triangles().size(); ++i) {
    Triangle triangle;
    triangle.corners = mesh->geometry->corners(i);
    triangle.thickness = mesh->geometry->rules().thickness;
    parts_.emplace_back(triangle, position, orientation, child.value_or(i));
    parts_.back().flap.emplace(parts_.back().shape, inner.of(i));
  }
}

CompositeOracle::CompositeOracle(const TestPair& pair) : a_(pair.a, {}), b_(parts_of_b(pair)) {}

void CompositeOracle::place_b(const TestPair& pair) { b_ = parts_of_b(pair); }

ExactParts CompositeOracle::parts_of_b(const TestPair& pair) {
  return {pair.b,
          oracle::vec3_as<long double>(pair.b.position) - oracle::vec3_as<Number>(pair.a.position)};
}

ExactSeparations CompositeOracle::separations() const {
  return least([](const ExactPart&, const ExactPart&) { return true; });
}

ExactSeparations CompositeOracle::separations(uint32_t sub_a, uint32_t sub_b) const {
  return least(
      [=](const ExactPart& a, const ExactPart& b) { return a.sub == sub_a && b.sub == sub_b; });
}

void CompositeOracle::note(const Candidate& candidate, ExactSeparations& found) const {
  const auto& [bound, a, b] = candidate;
  const auto answer = oracle::separation_with_normal(a->shape, b->shape);
  if (answer.value < found.all) {
    found.all = answer.value;
    found.normal = answer.normal;
  }
  const OverEdge over_edge = over_inner_edge(*a, *b, answer);
  if (over_edge == OverEdge::no) found.open = std::min(found.open, answer.value);
  if (over_edge != OverEdge::yes) found.not_closed = std::min(found.not_closed, answer.value);
}

OverEdge CompositeOracle::over_inner_edge(
    const ExactPart& a, const ExactPart& b,
    const oracle::ConvexSeparation<long double>& answer) const {
  const auto may_be = [](const ExactPart& part, const ExactPart& other) {
    return part.flap && part.flap->may_be_left_over_inner_edges(other.middle);
  };
  if (!may_be(a, b) && !may_be(b, a)) return OverEdge::no;
  const std::vector<Vec> ways = ways_out(a, b, answer);
  if (ways.empty()) return OverEdge::maybe;
  const OverEdge first = over_inner_edge(a, b, ways[0]);
  const bool is_sure = std::all_of(ways.begin(), ways.end(), [&](const Vec& way) {
    return over_inner_edge(a, b, way) == first;
  });
  return is_sure ? first : OverEdge::maybe;
}

OverEdge CompositeOracle::over_inner_edge(const ExactPart& a, const ExactPart& b, const Vec& way) {
  const auto over = [](const ExactPart& part, const ExactPart& other, const Vec& from_part) {
    return part.flap ? part.flap->over_inner_edge(other.middle, from_part) : OverEdge::no;
  };
  return std::max(over(a, b, way), over(b, a, -way));
}

std::vector<ExactPart::Vec> CompositeOracle::ways_out(
    const ExactPart& a, const ExactPart& b,
    const oracle::ConvexSeparation<long double>& answer) const {
  const Number cores = answer.value + a.shape.radius + b.shape.radius;
  if (cores > 0.02L * scale()) return {answer.normal};
  if (cores > 0) return {};
  std::vector<Vec> ways;
  Number best = -ExactSeparations::kNone;
  const auto try_way = [&](const Vec& n) {
    if (!(dot(n, n) > 0)) return;
    const Number gap = gap_along(a, b, n);
    best = std::max(best, gap);
    if (gap > answer.value - kAlike * scale()) ways.push_back(n);
  };
  for_each_axis(a.shape, b.shape, [&](const Vec& n) {
    try_way(n);
    try_way(-n);
  });
  return best > answer.value - 1e-12L * scale() ? ways : std::vector<Vec>{};
}

ExactPart::Number CompositeOracle::gap_along(const ExactPart& a, const ExactPart& b, const Vec& n) {
  return -b.shape.support(-n) - a.shape.support(n);
}

ExactPart::Number CompositeOracle::bound_by_boxes(const ExactPart& a, const ExactPart& b) {
  return std::max({b.lower.x - a.upper.x, a.lower.x - b.upper.x, b.lower.y - a.upper.y,
                   a.lower.y - b.upper.y, b.lower.z - a.upper.z, a.lower.z - b.upper.z});
}

ExactPart::Number CompositeOracle::bound_by_faces(const Candidate& candidate) {
  const auto& [bound, a, b] = candidate;
  Number most = bound;
  for (const auto* shape : {&a->shape, &b->shape}) {
    for (const Vec& n : shape->normals) {
      most = std::max({most, gap_along(*a, *b, n), gap_along(*a, *b, -n)});
    }
  }
  return most;
}

}  // namespace carom::test
