// Exact answers about meshes and compounds: the oracle of convex shapes tests every pair of parts
// in long double, except for pairs that bounds rule out. It shares no code with the midphase.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "oracle/convex_oracle.h"
#include "tests/support/inner_edges.h"
#include "tests/support/pairs.h"

namespace carom::test {

// A shape without parts, in coordinates relative to the position of A.
struct ExactPart {
  using Number = long double;
  using Vec = oracle::Vec3<Number>;

  oracle::ConvexShape<Number> shape;
  uint32_t sub;                   // index of the child or triangle
  std::optional<ExactFlap> flap;  // of triangles of meshes only
  Vec middle;                     // middle of the part's box in the part's frame
  Vec centre, lower, upper;       // a ball and a box around it
  Number radius = 0;

  ExactPart(const Shape& of, const Vec& position, const Eigen::Quaternionf& orientation,
            uint32_t name)
      : shape(of, Pose{Eigen::Vector3d::Zero(), orientation}), sub(name) {
    shape.translate(position);
    const oracle::Rotation<Number> turn(orientation);
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

 private:
  static Vec middle_of(const Shape& of) {
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
    return (oracle::vec3_as<Number>(low) + oracle::vec3_as<Number>(high)) * 0.5L;
  }
};

// All parts of a body.
class ExactParts {
 public:
  using Number = ExactPart::Number;
  using Vec = ExactPart::Vec;

  ExactParts(const PlacedShape& body, const Vec& position) {
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

  const std::vector<ExactPart>& all() const { return parts_; }
  Number bounding_radius() const { return bounding_radius_; }  // about the position of the body

 private:
  // The child's orientation is the product of the quaternions, rounded to float32. An aabb lies
  // along the axes of the compound.
  void add_child(const CompoundChild& child, const PlacedShape& body, const Vec& position,
                 uint32_t index) {
    const oracle::Rotation<Number> turn(body.orientation);
    Shape shape = child.shape;
    Vec at = oracle::vec3_as<Number>(child.position);
    Eigen::Quaternionf orientation =
        (body.orientation.cast<Number>() * child.orientation.cast<Number>()).cast<float>();
    if (const auto* box = std::get_if<Aabb>(&child.shape)) {
      at = at + (oracle::vec3_as<Number>(box->lower) + oracle::vec3_as<Number>(box->upper)) * 0.5L;
      shape = Box{(box->upper - box->lower) / 2};
      orientation = body.orientation;
    }
    add(shape, position + turn(at), orientation, index);
  }

  void add(const Shape& shape, const Vec& position, const Eigen::Quaternionf& orientation,
           const std::optional<uint32_t>& child) {
    const auto* mesh = std::get_if<Mesh>(&shape);
    if (!mesh) {
      parts_.emplace_back(shape, position, orientation, child.value_or(0));
      return;
    }
    const InnerEdges inner(*mesh);
    const auto vertices = mesh->geometry->vertices();
    for (uint32_t i = 0; i < mesh->geometry->triangles().size(); ++i) {
      Triangle triangle;
      for (size_t k = 0; k < 3; ++k) {
        triangle.corners[k] = vertices[mesh->geometry->triangles()[i][k]];
      }
      triangle.thickness = mesh->geometry->rules().thickness;
      parts_.emplace_back(triangle, position, orientation, child.value_or(i));
      parts_.back().flap.emplace(parts_.back().shape, inner.of(i));
    }
  }

  std::vector<ExactPart> parts_;
  Number bounding_radius_ = 0;
};

// The least separations of pairs of parts; infinite where there are none.
struct ExactSeparations {
  static constexpr long double kNone = std::numeric_limits<long double>::infinity();

  long double all = kNone;
  oracle::Vec3<long double> normal;  // from A to B, of the pair with the least separation of all
  long double open = kNone;          // least among pairs that surely do not meet over an inner edge
  long double not_closed = kNone;    // least among pairs that do not surely meet over one
};

class CompositeOracle {
 public:
  using Number = ExactPart::Number;
  using Vec = ExactPart::Vec;

  explicit CompositeOracle(const TestPair& pair)
      : a_(pair.a, {}),
        b_(pair.b,
           oracle::vec3_as<Number>(pair.b.position) - oracle::vec3_as<Number>(pair.a.position)) {}

  // L: the mean of the bounding radii.
  Number scale() const { return (a_.bounding_radius() + b_.bounding_radius()) / 2; }

  ExactSeparations separations() const {
    return least([](const ExactPart&, const ExactPart&) { return true; });
  }

  // The separations of the parts with these indices only.
  ExactSeparations separations(uint32_t sub_a, uint32_t sub_b) const {
    return least(
        [=](const ExactPart& a, const ExactPart& b) { return a.sub == sub_a && b.sub == sub_b; });
  }

 private:
  // In units of L: float32 tests may confuse penetration directions whose depths differ by less.
  static constexpr Number kAlike = 1e-5L;

  struct Candidate {
    Number bound;
    const ExactPart* a;
    const ExactPart* b;
  };

  // Visits pairs of parts in the order of their bounds, and stops when the rest cannot matter.
  template <class Filter>
  ExactSeparations least(const Filter& filter) const {
    ExactSeparations found;
    for (const Candidate& candidate : candidates(filter)) {
      const Number enough = std::max(found.all, std::min<Number>(found.open, 0));
      if (candidate.bound > enough) break;
      if (bound_by_faces(candidate) > enough) continue;
      note(candidate, found);
    }
    return found;
  }

  void note(const Candidate& candidate, ExactSeparations& found) const {
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

  OverEdge over_inner_edge(const ExactPart& a, const ExactPart& b,
                           const oracle::ConvexSeparation<Number>& answer) const {
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

  static OverEdge over_inner_edge(const ExactPart& a, const ExactPart& b, const Vec& way) {
    const auto over = [](const ExactPart& part, const ExactPart& other, const Vec& from_part) {
      return part.flap ? part.flap->over_inner_edge(other.middle, from_part) : OverEdge::no;
    };
    return std::max(over(a, b, way), over(b, a, -way));
  }

  // All directions from A to B along which the depth is about the least; none if that is unclear.
  // Cores that are clearly separate have a single direction; for overlapping cores the candidates
  // are the axes of their faces and edges.
  std::vector<Vec> ways_out(const ExactPart& a, const ExactPart& b,
                            const oracle::ConvexSeparation<Number>& answer) const {
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

  template <class Use>
  static void for_each_axis(const oracle::ConvexShape<Number>& a,
                            const oracle::ConvexShape<Number>& b, const Use& use) {
    for (const Vec& n : a.normals) use(n);
    for (const Vec& n : b.normals) use(n);
    for (const Vec& u : a.directions) {
      for (const Vec& v : b.directions) use(oracle::common_normal(u, v));
    }
  }

  // The pairs of parts whose lower bound is at most the least distance of two points of parts, in
  // the order of the bounds.
  template <class Filter>
  std::vector<Candidate> candidates(const Filter& filter) const {
    std::vector<Candidate> all;
    Number enough = ExactSeparations::kNone;
    for (const ExactPart& a : a_.all()) {
      for (const ExactPart& b : b_.all()) {
        if (!filter(a, b)) continue;
        const Number centres = length(b.centre - a.centre);
        enough = std::min(enough, centres);
        const Number bound = std::max(centres - a.radius - b.radius, bound_by_boxes(a, b));
        if (bound <= enough) all.push_back({bound, &a, &b});
      }
    }
    std::erase_if(all, [&](const Candidate& candidate) { return candidate.bound > enough; });
    std::sort(all.begin(), all.end(),
              [](const Candidate& x, const Candidate& y) { return x.bound < y.bound; });
    return all;
  }

  // The gap along any direction is a lower bound of the separation.
  static Number gap_along(const ExactPart& a, const ExactPart& b, const Vec& n) {
    return -b.shape.support(-n) - a.shape.support(n);
  }

  static Number bound_by_boxes(const ExactPart& a, const ExactPart& b) {
    return std::max({b.lower.x - a.upper.x, a.lower.x - b.upper.x, b.lower.y - a.upper.y,
                     a.lower.y - b.upper.y, b.lower.z - a.upper.z, a.lower.z - b.upper.z});
  }

  static Number bound_by_faces(const Candidate& candidate) {
    const auto& [bound, a, b] = candidate;
    Number most = bound;
    for (const auto* shape : {&a->shape, &b->shape}) {
      for (const Vec& n : shape->normals) {
        most = std::max({most, gap_along(*a, *b, n), gap_along(*a, *b, -n)});
      }
    }
    return most;
  }

  ExactParts a_, b_;
};

}  // namespace carom::test
