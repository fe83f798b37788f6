#include "sweep/gather_linear.h"

#include <algorithm>
#include <array>

namespace carom {
namespace {

// The next column of a row.
class RowWriter {
 public:
  RowWriter(LinearRows& rows, size_t column, size_t row) : next_(rows.column(column) + row) {}

  void put(double value) {
    *next_ = value;
    next_ += LinearRows::kMost;
  }
  template <class Vector>
  void put3(const Vector& v) {
    for (int axis = 0; axis < 3; ++axis) put(v[axis]);
  }
  void put4(const Row& q) {
    for (const float x : q) put(x);
  }

 private:
  double* next_;
};

constexpr Row kIdentity = {0, 0, 0, 1};

// put() writes the numbers of a body and returns its greatest coordinate; offset() is where they
// are about, from the body's position.
template <LinearKind kKind>
struct Numbers;

struct AboutPosition {
  static Eigen::Vector3d offset(const BodyReader&, size_t) { return Eigen::Vector3d::Zero(); }
};

template <>
struct Numbers<LinearKind::sphere> : AboutPosition {
  static double put(const BodyReader& body, size_t i, RowWriter out) {
    const double radius = body.radius(i);
    out.put(radius);
    return radius;
  }
};

template <>
struct Numbers<LinearKind::capsule> : AboutPosition {
  static double put(const BodyReader& body, size_t i, RowWriter out) {
    const Row a = body.row(i, 0), b = body.row(i, 1);
    const double radius = a[3];
    out.put3(a);
    out.put3(b);
    out.put(radius);
    out.put4(body.orientation(i));
    return std::max({greatest(vector_of(a)), greatest(vector_of(b)), radius});
  }
};

template <>
struct Numbers<LinearKind::box> {
  static bool is_turned(const BodyReader& body, size_t i) { return body.kind(i) == ShapeKind::box; }
  static double put(const BodyReader& body, size_t i, RowWriter out) {
    Double3 half;
    if (is_turned(body, i)) {
      half = vector_of(body.row(i, 0));
    } else {
      for (size_t axis = 0; axis < 3; ++axis) {
        half[axis] = (double{body.upper(axis, i)} - double{body.lower(axis, i)}) * 0.5;
      }
    }
    out.put3(half);
    out.put4(is_turned(body, i) ? body.orientation(i) : kIdentity);
    return greatest(half);
  }
  static Eigen::Vector3d offset(const BodyReader& body, size_t i) {
    if (is_turned(body, i)) return Eigen::Vector3d::Zero();
    const auto middle = [&](size_t axis) {
      return (double{body.lower(axis, i)} + double{body.upper(axis, i)}) * 0.5;
    };
    return {middle(0), middle(1), middle(2)};
  }
};

template <>
struct Numbers<LinearKind::triangle> : AboutPosition {
  static double put(const BodyReader& body, size_t i, RowWriter out) {
    double size = 0;
    for (size_t corner = 0; corner < 3; ++corner) {
      const Row row = body.row(i, corner);
      out.put3(row);
      size = std::max(size, greatest(vector_of(row)));
    }
    out.put4(body.orientation(i));
    return size;
  }
};

// Of a half-space seen from the other body, at -from.
double put_plane(const MovingReader& halfspace, size_t i, const reference::LinearPose& pose,
                 RowWriter out) {
  const Row row = halfspace.body().row(i, 0);
  const auto shape = reference::shape_as<double>(Halfspace{{row[0], row[1], row[2]}, row[3]});
  const reference::LinearPlane plane(shape, pose);
  out.put3(plane.normal);
  out.put(plane.height);
  out.put(plane.rate);
  return shape.size();
}

template <LinearKind kA, LinearKind kB>
bool gather_pair(const MovingReader& a, const MovingReader& b, Pair pair, LinearRows& rows,
                 size_t row) {
  using NumbersOfA = Numbers<kA>;
  constexpr size_t kFirstOfA = LinearRows::kPairColumns;
  Eigen::Vector3d from = position_from(a, b, pair);
  const Eigen::Vector3d way = way_from(a, b, pair);
  double sizes = NumbersOfA::put(a.body(), pair.a, {rows, kFirstOfA, row});
  const RowWriter out_b(rows, kFirstOfA + number_count(kA), row);
  if constexpr (kB == LinearKind::plane) {
    from -= NumbersOfA::offset(a.body(), pair.a);
    const reference::LinearPose pose{from, way, {}, b.orientation(pair.b), 0};
    sizes += put_plane(b, pair.b, pose, out_b);
  } else {
    from = (from + Numbers<kB>::offset(b.body(), pair.b)) - NumbersOfA::offset(a.body(), pair.a);
    sizes += Numbers<kB>::put(b.body(), pair.b, out_b);
  }
  const double lengths =
      (reference::largest_component(from) + reference::largest_component(way)) + sizes;
  RowWriter out(rows, 0, row);
  out.put3(from);
  out.put3(way);
  out.put(kSweepSlack * lengths);
  return a.is_valid(pair.a) && b.is_valid(pair.b);
}

// Views are copied, so that what is written cannot be taken for a part of them.
template <LinearKind kA, LinearKind kB>
void gather(const MovingSide& side_a, const MovingSide& side_b, const LinearPairs& pairs,
            LinearRows& rows, bool* valid) {
  const Collidables bodies_a = side_a.bodies, bodies_b = side_b.bodies;
  const MovingSide a{bodies_a, side_a.sweep, side_a.arm}, b{bodies_b, side_b.sweep, side_b.arm};
  const LinearPairs list = pairs;
  for (size_t i = 0; i < list.rows.size(); ++i) {
    valid[i] = gather_pair<kA, kB>({a}, {b}, list.pair(i), rows, i);
  }
}

template <LinearKind kA>
GatherLinear gather_with(LinearKind b) {
  using enum LinearKind;
  if (b == capsule) return gather<kA, capsule>;
  if (b == box) return gather<kA, box>;
  if (b == triangle) return gather<kA, triangle>;
  if (b == plane) return gather<kA, plane>;
  return gather<kA, sphere>;
}

}  // namespace

GatherLinear gather_linear(LinearKind a, LinearKind b) {
  using enum LinearKind;
  if (a == capsule) return gather_with<capsule>(b);
  if (a == box) return gather_with<box>(b);
  if (a == triangle) return gather_with<triangle>(b);
  return gather_with<sphere>(b);
}

}  // namespace carom
