// Fills column by column, so that the layout of a view is examined once per column and not once per
// body.
#include "impacts/linear/gather_linear.h"

#include <algorithm>
#include <array>

#include "impacts/body_columns.h"

namespace carom {
namespace {

// Writes the numbers of one body, one per column.
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

// The bodies of a side.
struct Side : BodyColumns {
  const LinearKind kind;
  const uint32_t* const body;

  explicit Side(const LinearSide& side)
      : BodyColumns(side.side), kind(side.kind), body(side.body) {}

  Row row(size_t i, size_t k) const {
    return row_at(bodies.rows.data, sizeof(Row), reader().first_row(i) + k);
  }
  Row orientation(size_t i) const {
    if (!bodies.orientation.data) return {0, 0, 0, 1};
    return row_at(bodies.orientation.data, bodies.orientation.stride, i);
  }

  bool is_turned_box(size_t i) const { return reader().kind(i) == ShapeKind::box; }

 private:
  // Reads one number at a time; a row that is copied whole would be taken apart by shifts.
  static Row row_at(const float* data, size_t stride, size_t i) {
    const char* row = reinterpret_cast<const char*>(data) + i * stride;
    const auto number = [&](size_t k) { return load_strided<float>(row, sizeof(float), k); };
    return {number(0), number(1), number(2), number(3)};
  }
};

class LinearGather {
 public:
  LinearGather(size_t count, LinearRows& rows, bool* valid)
      : count_(count), rows_(rows), valid_(valid) {}

  void run(const Side& a, const Side& b) {
    const size_t first_of_a = LinearRows::kPairColumns;
    const size_t first_of_b = first_of_a + number_count(a.kind);
    put_places(a, b);
    put_ways(a, b);
    check_rotations(a);
    check_rotations(b);
    add_middles(b, 1);
    add_middles(a, -1);
    if (b.kind == LinearKind::hull) {
      put_hulls(a, first_of_a, rows_.hull_a());
      put_hulls(b, first_of_b, rows_.hull_b());
      put_rotations(a, first_of_b + number_count(b.kind));
      put_rotations(b, first_of_b + number_count(b.kind) + 3);
      return;
    }
    put_bodies(a, first_of_a);
    if (b.kind == LinearKind::plane) {
      put_planes(b, first_of_b);
    } else {
      put_bodies(b, first_of_b);
    }
  }

 private:
  void check(size_t row, bool is_valid) { valid_[row] = valid_[row] & is_valid; }

  // Writes between(component of A, component of B) of every row into three columns.
  template <class OfA, class OfB, class Between>
  void put_between(const OfA& of_a, const uint32_t* a, const OfB& of_b, const uint32_t* b,
                   size_t column, const Between& between) {
    double *const x = rows_.column(column), *const y = rows_.column(column + 1),
                  *const z = rows_.column(column + 2);
    for (size_t i = 0; i < count_; ++i) {
      const auto p = of_a[a[i]];
      const auto q = of_b[b[i]];
      x[i] = between(p.x, q.x);
      y[i] = between(p.y, q.y);
      z[i] = between(p.z, q.z);
      check(i, is_finite(p) && is_finite(q));
    }
  }

  void put_places(const Side& a, const Side& b) {
    std::fill_n(valid_, count_, true);
    a.with_positions([&](const auto& of_a) {
      b.with_positions([&](const auto& of_b) {
        // Adds zero, as for kinds with a middle, so that no zero is negative.
        put_between(of_a, a.body, of_b, b.body, 0,
                    [](double from, double to) { return apart(from, to) + 0.0; });
      });
    });
  }

  void put_ways(const Side& a, const Side& b) {
    put_between(a.displacement(), a.body, b.displacement(), b.body, 3,
                [](double of_a, double of_b) { return of_b - of_a; });
  }

  // Rotations must be finite even if the bodies do not turn.
  void check_rotations(const Side& side) {
    if (!side.sweep.rotation) return;
    const Strided<Position<float>> rotation = side.rotation();
    for (size_t i = 0; i < count_; ++i) check(i, is_finite(rotation[side.body[i]]));
  }

  // An aabb is a box about its middle.
  void add_middles(const Side& side, double sign) {
    if (side.kind != LinearKind::box) return;
    const BodyReader reader = side.reader();
    for (size_t i = 0; i < count_; ++i) {
      const uint32_t body = side.body[i];
      if (side.is_turned_box(body)) continue;
      for (size_t axis = 0; axis < 3; ++axis) {
        const double ends = double{reader.lower(axis, body)} + double{reader.upper(axis, body)};
        rows_.column(axis)[i] += sign * (ends * 0.5);
      }
    }
  }

  void put_bodies(const Side& side, size_t column) {
    switch (side.kind) {
      case LinearKind::sphere:
        return put_spheres(side, column);
      case LinearKind::capsule:
        return put_turned<ShapeKind::capsule>(side, column);
      case LinearKind::triangle:
        return put_turned<ShapeKind::triangle>(side, column);
      default:
        return put_boxes(side, column);
    }
  }

  void put_spheres(const Side& side, size_t column) {
    double* const out = rows_.column(column);
    side.with_radii([&](const auto& radii) {
      for (size_t i = 0; i < count_; ++i) {
        const auto radius = static_cast<float>(radii[side.body[i]]);
        out[i] = radius;
        check(i, is_valid_radius(radius));
      }
    });
  }

  // Writes points, the radius of a capsule, and a quaternion.
  template <ShapeKind kKind>
  void put_turned(const Side& side, size_t column) {
    for (size_t i = 0; i < count_; ++i) {
      const uint32_t body = side.body[i];
      std::array<Row, row_count(kKind)> rows;
      for (size_t k = 0; k < rows.size(); ++k) rows[k] = side.row(body, k);
      const Row q = side.orientation(body);
      RowWriter out(rows_, column, i);
      for (const Row& row : rows) out.put3(row);
      if (kKind == ShapeKind::capsule) out.put(rows[0][3]);
      out.put4(q);
      check(i, are_valid_rows(kKind, rows.data()) && is_rotation(q));
    }
  }

  void put_boxes(const Side& side, size_t column) {
    for (size_t i = 0; i < count_; ++i) {
      const uint32_t body = side.body[i];
      const RowWriter out(rows_, column, i);
      check(i, side.is_turned_box(body) ? put_box(side, body, out)
                                        : put_aabb(side.reader(), body, out));
    }
  }

  static bool put_box(const Side& side, uint32_t body, RowWriter out) {
    const Row half = side.row(body, 0), q = side.orientation(body);
    out.put3(half);
    out.put4(q);
    return are_valid_rows(ShapeKind::box, &half) && is_rotation(q);
  }

  static bool put_aabb(const BodyReader& reader, uint32_t body, RowWriter out) {
    bool is_valid = true;
    for (size_t axis = 0; axis < 3; ++axis) {
      const float lower = reader.lower(axis, body), upper = reader.upper(axis, body);
      out.put((double{upper} - double{lower}) * 0.5);
      is_valid = is_valid && is_valid_box_axis(lower, upper);
    }
    out.put4(Row{0, 0, 0, 1});
    return is_valid;
  }

  void put_hulls(const Side& side, size_t column, const HullGeometry** hulls) {
    for (size_t i = 0; i < count_; ++i) {
      const uint32_t body = side.body[i];
      hulls[i] = geometry_at<HullGeometry>(side.row(body, 0));
      const Row q = side.orientation(body);
      const Eigen::Vector3d middle =
          hulls[i] ? hulls[i]->middle() : Eigen::Vector3d(Eigen::Vector3d::Zero());
      RowWriter out(rows_, column, i);
      out.put3(middle);
      out.put(hulls[i] ? hulls[i]->size() : 0);
      out.put4(q);
      check(i, hulls[i] != nullptr && is_rotation(q));
    }
  }

  void put_rotations(const Side& side, size_t column) {
    if (!side.sweep.rotation) return rows_.clear(column, 3, count_);
    const Strided<Position<float>> rotation = side.rotation();
    for (size_t i = 0; i < count_; ++i) {
      const Position<float> w = rotation[side.body[i]];
      RowWriter(rows_, column, i).put3(std::array{w.x, w.y, w.z});
    }
  }

  // Half-spaces relative to the other bodies, whose positions are in the first columns.
  void put_planes(const Side& side, size_t column) {
    const auto vector_at = [&](size_t first, size_t i) {
      return Eigen::Vector3d{rows_.column(first)[i], rows_.column(first + 1)[i],
                             rows_.column(first + 2)[i]};
    };
    for (size_t i = 0; i < count_; ++i) {
      const Row row = side.row(side.body[i], 0), q = side.orientation(side.body[i]);
      const auto shape = scalar::shape_as<double>(Halfspace{{row[0], row[1], row[2]}, row[3]});
      const scalar::LinearPose pose{
          vector_at(0, i), vector_at(3, i), {}, {{q[0], q[1], q[2]}, q[3]}, 0};
      const scalar::LinearPlane plane(shape, pose);
      RowWriter out(rows_, column, i);
      out.put3(plane.normal);
      out.put(plane.height);
      out.put(plane.rate);
      out.put(shape.size());
      check(i, are_valid_rows(ShapeKind::halfspace, &row) && is_rotation(q));
    }
  }

  const size_t count_;
  LinearRows& rows_;
  bool* const valid_;
};

}  // namespace

void gather_linear(const LinearSide& a, const LinearSide& b, size_t count, LinearRows& rows,
                   bool* valid) {
  LinearGather(count, rows, valid).run(Side(a), Side(b));
}

}  // namespace carom
