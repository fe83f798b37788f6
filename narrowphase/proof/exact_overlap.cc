#include "narrowphase/proof/exact_overlap.h"

#include <utility>

#include "narrowphase/proof/exact_body.h"

namespace carom {
namespace {

// Two bodies. Their common unit is A's unit times B's unit.
struct ExactPair {
  ExactBody a, b;
  ExactVector way;  // B - A of the positions, in metres
};

// --- Shapes from behind a one-sided triangle ---

// `way` leads from the triangle's position to the other position, in metres.
bool comes_from_behind(const ExactBody& triangle, const ExactBody& other, const ExactVector& way) {
  if (!triangle.is_one_sided) return false;
  if (other.is_halfspace) return sign_of(dot(triangle.front, other.front)) > 0;
  const Dyadic count = static_cast<double>(other.points.size());
  const Dyadic unit = count * other.unit;
  const ExactVector to_middle =
      (other.middle * triangle.unit + way * (unit * triangle.unit)) - triangle.points[0] * unit;
  const Dyadic height = dot(triangle.front, to_middle);
  if (height.sign() >= 0) return false;
  const Dyadic depth = Dyadic(triangle.thickness) * unit * triangle.unit;
  const Dyadic squared = dot(triangle.front, triangle.front);
  return (height * height - depth * depth * squared).sign() > 0;
}

// --- Numbers with as many roots as there are thick triangles ---

using OneRoot = Surd<Dyadic>;
using TwoRoots = Surd<OneRoot>;

enum class Root { first, second };

void put(Dyadic& number, const Dyadic& a, const Dyadic&, const Dyadic&, Root) { number = a; }
void put(OneRoot& number, const Dyadic& a, const Dyadic& b, const Dyadic& radicand, Root) {
  number = b.is_zero() ? OneRoot(a) : OneRoot(a, b, radicand);
}
void put(TwoRoots& number, const Dyadic& a, const Dyadic& b, const Dyadic& radicand, Root root) {
  if (root == Root::first || b.is_zero()) {
    OneRoot inner;
    put(inner, a, b, radicand, root);
    number = inner;
  } else {
    number = {OneRoot(a), OneRoot(b), radicand};
  }
}

template <class Number>
VectorOf<Number> vector_of(const ExactVector& a, const ExactVector& b, const Dyadic& radicand,
                           Root root) {
  VectorOf<Number> v;
  put(v.x, a.x, b.x, radicand, root);
  put(v.y, a.y, b.y, radicand, root);
  put(v.z, a.z, b.z, radicand, root);
  return v;
}

// Scales the hull, then moves it by `shift`, which is in units of the result.
template <class Number>
GrownHull<Number> hull_of(const ExactBody& body, const Dyadic& scale, const ExactVector& shift,
                          Root root) {
  GrownHull<Number> hull;
  const ExactVector depth = body.depth * scale;
  for (const ExactVector& point : body.points) {
    const ExactVector p = point * scale + shift;
    hull.points.push_back(vector_of<Number>(p, {}, body.depth_radicand, root));
    if (body.thickness > 0) {
      hull.points.push_back(vector_of<Number>(p, depth, body.depth_radicand, root));
    }
  }
  hull.radius = Number(body.radius * body.unit * scale);
  return hull;
}

template <class Number>
bool hulls_overlap(const ExactPair& pair) {
  const Dyadic unit = pair.a.unit * pair.b.unit;
  const auto a = hull_of<Number>(pair.a, pair.b.unit, {}, Root::first);
  const auto b = hull_of<Number>(pair.b, pair.a.unit, pair.way * unit, Root::second);
  return OverlapSearch<Number>(a, b).run().overlap;
}

// Whether B reaches into A, the half-space.
template <class Number>
bool reaches_into(const ExactPair& pair) {
  const ExactBody &plane = pair.a, &body = pair.b;
  const auto hull = hull_of<Number>(body, 1.0, pair.way * body.unit, Root::first);
  const VectorOf<Number> normal = vector_of<Number>(plane.front, {}, {}, Root::first);
  Number lowest = dot(normal, hull.points[0]);
  for (const VectorOf<Number>& p : hull.points) {
    const Number height = dot(normal, p);
    if (sign_of(height - lowest) < 0) lowest = height;
  }
  lowest = lowest - Number(plane.offset * body.unit);
  if (sign_of(lowest) <= 0) return true;
  return sign_of(lowest * lowest - hull.radius * hull.radius * dot(normal, normal)) <= 0;
}

bool shapes_overlap(const ExactPair& pair) {
  const bool is_thick_a = pair.a.thickness > 0, is_thick_b = pair.b.thickness > 0;
  if (pair.a.is_halfspace) {
    return is_thick_b ? reaches_into<OneRoot>(pair) : reaches_into<Dyadic>(pair);
  }
  if (is_thick_a && is_thick_b) return hulls_overlap<TwoRoots>(pair);
  return is_thick_a || is_thick_b ? hulls_overlap<OneRoot>(pair) : hulls_overlap<Dyadic>(pair);
}

}  // namespace

bool exact_overlap(const StatedBody& a, const StatedBody& b) {
  ExactPair pair{exact_body(a), exact_body(b), exact_way(a, b)};
  if (comes_from_behind(pair.a, pair.b, pair.way) || comes_from_behind(pair.b, pair.a, -pair.way)) {
    return false;
  }
  if (pair.b.is_halfspace) {
    std::swap(pair.a, pair.b);
    pair.way = -pair.way;
  }
  return shapes_overlap(pair);
}

}  // namespace carom
