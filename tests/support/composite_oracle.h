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
            uint32_t name);

 private:
  static Vec middle_of(const Shape& of);
};

// All parts of a body.
class ExactParts {
 public:
  using Number = ExactPart::Number;
  using Vec = ExactPart::Vec;

  ExactParts(const PlacedShape& body, const Vec& position);

  const std::vector<ExactPart>& all() const { return parts_; }
  Number bounding_radius() const { return bounding_radius_; }  // about the position of the body

 private:
  // The child's orientation is the product of the quaternions, rounded to float32. An aabb lies
  // along the axes of the compound.
  void add_child(const CompoundChild& child, const PlacedShape& body, const Vec& position,
                 uint32_t index);

  void add(const Shape& shape, const Vec& position, const Eigen::Quaternionf& orientation,
           const std::optional<uint32_t>& child);

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

  explicit CompositeOracle(const TestPair& pair);

  // Takes the place of B from the pair, of which nothing else has changed.
  void place_b(const TestPair& pair);

  // L: the mean of the bounding radii.
  Number scale() const { return (a_.bounding_radius() + b_.bounding_radius()) / 2; }

  ExactSeparations separations() const;

  // The separations of the parts with these indices only.
  ExactSeparations separations(uint32_t sub_a, uint32_t sub_b) const;

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

  void note(const Candidate& candidate, ExactSeparations& found) const;

  OverEdge over_inner_edge(const ExactPart& a, const ExactPart& b,
                           const oracle::ConvexSeparation<Number>& answer) const;

  static OverEdge over_inner_edge(const ExactPart& a, const ExactPart& b, const Vec& way);

  // All directions from A to B along which the depth is about the least; none if that is unclear.
  // Cores that are clearly separate have a single direction; for overlapping cores the candidates
  // are the axes of their faces and edges.
  std::vector<Vec> ways_out(const ExactPart& a, const ExactPart& b,
                            const oracle::ConvexSeparation<Number>& answer) const;

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
  static Number gap_along(const ExactPart& a, const ExactPart& b, const Vec& n);

  static ExactParts parts_of_b(const TestPair& pair);

  static Number bound_by_boxes(const ExactPart& a, const ExactPart& b);

  static Number bound_by_faces(const Candidate& candidate);

  ExactParts a_, b_;
};

}  // namespace carom::test
