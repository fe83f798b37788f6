#include "sweep/gather_linear.h"

#include <array>

namespace carom {
namespace {

// The next column of a row.
class RowWriter {
 public:
  RowWriter(LinearRows& rows, size_t column, size_t row) : next_(rows.column(column) + row) {}

  void put(double value) {
    *next_ = value;
    next_ += LinearRows::kStride;
  }
  template <class Vector>
  void put3(const Vector& v) {
    for (size_t axis = 0; axis < 3; ++axis) put(v[axis]);
  }
  void put4(const Row& q) {
    for (const float x : q) put(x);
  }

 private:
  double* next_;
};

bool is_rotation(const Row& q) {
  return is_finite(q) && (is_direction(q[0], q[1], q[2]) || q[3] != 0);
}

constexpr Row kIdentity = {0, 0, 0, 1};

// put() writes the numbers of a body, and says whether they are valid; offset() is where they are
// about, from the body's position.
template <LinearKind kKind>
struct Numbers;

struct AboutPosition {
  static Double3 offset(const BodyReader&, size_t) { return {}; }
};

template <>
struct Numbers<LinearKind::sphere> : AboutPosition {
  static bool put(const BodyReader& body, size_t i, RowWriter out) {
    const float radius = body.radius(i);
    out.put(radius);
    return is_valid_radius(radius);
  }
};

template <>
struct Numbers<LinearKind::capsule> : AboutPosition {
  static bool put(const BodyReader& body, size_t i, RowWriter out) {
    const std::array<Row, 2> rows = {body.row(i, 0), body.row(i, 1)};
    const Row q = body.orientation(i);
    out.put3(rows[0]);
    out.put3(rows[1]);
    out.put(rows[0][3]);
    out.put4(q);
    return are_valid_rows(ShapeKind::capsule, rows.data()) && is_rotation(q);
  }
};

template <>
struct Numbers<LinearKind::box> {
  static bool put(const BodyReader& body, size_t i, RowWriter out) {
    return is_turned(body, i) ? put_box(body, i, out) : put_aabb(body, i, out);
  }

  static Double3 offset(const BodyReader& body, size_t i) {
    if (is_turned(body, i)) return {};
    const auto middle = [&](size_t axis) {
      return (double{body.lower(axis, i)} + double{body.upper(axis, i)}) * 0.5;
    };
    return {middle(0), middle(1), middle(2)};
  }

 private:
  static bool is_turned(const BodyReader& body, size_t i) { return body.kind(i) == ShapeKind::box; }

  static bool put_box(const BodyReader& body, size_t i, RowWriter out) {
    const Row half = body.row(i, 0), q = body.orientation(i);
    out.put3(half);
    out.put4(q);
    return are_valid_rows(ShapeKind::box, &half) && is_rotation(q);
  }

  static bool put_aabb(const BodyReader& body, size_t i, RowWriter out) {
    bool is_valid = true;
    for (size_t axis = 0; axis < 3; ++axis) {
      const float lower = body.lower(axis, i), upper = body.upper(axis, i);
      out.put((double{upper} - double{lower}) * 0.5);
      is_valid = is_valid && is_valid_box_axis(lower, upper);
    }
    out.put4(kIdentity);
    return is_valid;
  }
};

template <>
struct Numbers<LinearKind::triangle> : AboutPosition {
  static bool put(const BodyReader& body, size_t i, RowWriter out) {
    const std::array<Row, 3> rows = {body.row(i, 0), body.row(i, 1), body.row(i, 2)};
    const Row q = body.orientation(i);
    for (const Row& row : rows) out.put3(row);
    out.put4(q);
    return are_valid_rows(ShapeKind::triangle, rows.data()) && is_rotation(q);
  }
};

// Of a half-space seen from the other body, at -from.
bool put_plane(const MovingReader& halfspace, size_t i, const reference::LinearPose& pose,
               RowWriter out) {
  const Row row = halfspace.body().row(i, 0), q = halfspace.body().orientation(i);
  const auto shape = reference::shape_as<double>(Halfspace{{row[0], row[1], row[2]}, row[3]});
  const reference::LinearPlane plane(shape, pose);
  out.put3(Double3{plane.normal.x(), plane.normal.y(), plane.normal.z()});
  out.put(plane.height);
  out.put(plane.rate);
  out.put(shape.size());
  return are_valid_rows(ShapeKind::halfspace, &row) && is_rotation(q);
}

template <LinearKind kA, LinearKind kB>
bool gather_pair(const MovingReader& a, const MovingReader& b, Pair pair, LinearRows& rows,
                 size_t row) {
  using NumbersOfA = Numbers<kA>;
  constexpr size_t kFirstOfA = LinearRows::kPairColumns;
  const Double3 way = way_between(a, b, pair);
  Double3 from = place_between(a, b, pair);
  const Double3 offset_a = NumbersOfA::offset(a.body(), pair.a);
  const RowWriter out_b(rows, kFirstOfA + number_count(kA), row);
  bool is_valid = NumbersOfA::put(a.body(), pair.a, {rows, kFirstOfA, row});
  if constexpr (kB == LinearKind::plane) {
    for (size_t axis = 0; axis < 3; ++axis) from[axis] -= offset_a[axis];
    const reference::LinearPose pose{eigen(from), eigen(way), {}, b.orientation(pair.b), 0};
    is_valid = put_plane(b, pair.b, pose, out_b) && is_valid;
  } else {
    const Double3 offset_b = Numbers<kB>::offset(b.body(), pair.b);
    for (size_t axis = 0; axis < 3; ++axis) {
      from[axis] = (from[axis] + offset_b[axis]) - offset_a[axis];
    }
    is_valid = Numbers<kB>::put(b.body(), pair.b, out_b) && is_valid;
  }
  RowWriter out(rows, 0, row);
  out.put3(from);
  out.put3(way);
  return is_valid && a.has_valid_motion(pair.a) && b.has_valid_motion(pair.b);
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
