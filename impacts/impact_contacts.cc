#include "impacts/impact_contacts.h"

#include <array>
#include <limits>
#include <memory>
#include <optional>

#include "impacts/composite_times.h"
#include "impacts/moving_body.h"
#include "midphase/part_batch.h"
#include "narrowphase/blocks/pair_block.h"

namespace carom {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The pose of a body, or of a part, at a time.
struct PlaceInTime {
  Double3 position;
  Double3 arm;  // from the pivot of the body
  Row orientation;
};

PlaceInTime place_at(const Double3& pivot, const Double3& arm, const Row& orientation,
                     const MovingReader& side, size_t body, double t) {
  const Position<float> d = side.displacement(body);
  const Double3 moved = plus(pivot, {d.x * t, d.y * t, d.z * t});
  const Eigen::Vector3d rotation = side.rotation_vector(body);
  if (rotation.isZero(0)) return {plus(moved, arm), arm, orientation};
  const scalar::Quaternion<double> turn = scalar::turn_by(rotation, t);
  const Eigen::Vector3d turned_arm =
      scalar::rotate(scalar::rotation_of(turn), Eigen::Vector3d(arm.data()));
  const Double3 arm_then = {turned_arm.x(), turned_arm.y(), turned_arm.z()};
  const Row as_row = {static_cast<float>(turn.v.x()), static_cast<float>(turn.v.y()),
                      static_cast<float>(turn.v.z()), static_cast<float>(turn.w)};
  return {plus(moved, arm_then), arm_then, product(as_row, orientation)};
}

// Simple bodies at their times of impact, packed. Their shape rows stay in the caller's arrays.
class PlacedSide {
 public:
  void clear() { count_ = 0; }

  // `position` is that at the start.
  void put(const MovingReader& side, size_t body, const Double3& position, double t) {
    const BodyReader reader = side.body();
    const PlaceInTime place = place_at(position, {}, reader.orientation(body), side, body, t);
    kind_[count_] = reader.kind(body);
    const bool is_sphere = kind_[count_] == ShapeKind::sphere;
    record_[count_] = {place.position[0], place.position[1], place.position[2],
                       is_sphere ? reader.radius(body) : 0.0};
    orientation_[count_] = place.orientation;
    first_row_[count_] =
        row_count(kind_[count_]) > 0 ? static_cast<uint32_t>(reader.first_row(body)) : 0;
    box_slot_[count_] = static_cast<uint32_t>(reader.box(body));
    ++count_;
  }

  Collidables view(const Collidables& bodies) const {
    Collidables view;
    view.count = count_;
    view.position = {
        .data = record_.data(), .stride = sizeof record_[0], .type = PositionType::float64};
    view.kind = bodies.kind ? kind_.data() : nullptr;
    view.uniform_kind = bodies.uniform_kind;
    view.boxes = bodies.boxes;
    view.box_slot = box_slot_.data();
    view.orientation.data = orientation_[0].data();
    view.rows = {bodies.rows.data, first_row_.data()};
    return view;
  }

 private:
  size_t count_ = 0;
  alignas(64) std::array<std::array<double, 4>, kPairsPerBlock> record_;
  std::array<Row, kPairsPerBlock> orientation_;
  std::array<ShapeKind, kPairsPerBlock> kind_;
  std::array<uint32_t, kPairsPerBlock> first_row_, box_slot_;
};

// Points and the triangles of meshes that they meet, packed.
class TouchedTriangles {
 public:
  size_t count() const { return count_; }
  size_t row(size_t i) const { return row_[i]; }
  void clear() { count_ = 0; }

  // The positions are relative to a frame of the pair's own.
  void put(size_t row, const Double3& point, const Double3& position, const Row& orientation,
           const MeshGeometry& mesh, uint32_t triangle, std::optional<bool> one_sided) {
    row_[count_] = static_cast<uint16_t>(row);
    point_[count_] = {point[0], point[1], point[2], 0};
    position_[count_] = {position[0], position[1], position[2], 0};
    orientation_[count_] = orientation;
    put_triangle_rows(mesh, triangle, rows_[count_].data());
    if (one_sided) rows_[count_][1][3] = *one_sided ? 1.0f : 0.0f;
    ++count_;
  }

  Collidables points() const { return view(ShapeKind::sphere, point_); }
  Collidables triangles() const {
    Collidables view = this->view(ShapeKind::triangle, position_);
    view.orientation.data = orientation_[0].data();
    view.rows.data = rows_[0][0].data();
    return view;
  }

 private:
  using Records = std::array<std::array<double, 4>, kPairsPerBlock>;

  Collidables view(ShapeKind kind, const Records& records) const {
    Collidables view;
    view.count = count_;
    view.position = {
        .data = records.data(), .stride = sizeof records[0], .type = PositionType::float64};
    view.uniform_kind = kind;
    return view;
  }

  size_t count_ = 0;
  std::array<uint16_t, kPairsPerBlock> row_;
  alignas(64) Records point_, position_;
  std::array<Row, kPairsPerBlock> orientation_;
  std::array<std::array<Row, row_count(ShapeKind::triangle)>, kPairsPerBlock> rows_;
};

struct ContactScratch {
  PlacedSide a, b;
  size_t count;
  std::array<uint16_t, kPairsPerBlock> row;  // of every placed pair
  TestColumns columns;
  TouchedTriangles triangles;
  PartBatch parts;
  std::array<std::array<Double3, 2>, kPairsPerBlock> arms;  // of the parts of every pair
};

class ImpactContacts {
 public:
  ImpactContacts(const MovingSide& a, const MovingSide& b, const Pair* pairs,
                 const FirstTimes& first, WitnessFrame frame, const ImpactColumns& out,
                 ContactScratch& scratch)
      : side_a_(a),
        side_b_(b),
        a_{a},
        b_{b},
        pairs_(pairs),
        first_(first),
        frame_(frame),
        out_(out),
        scratch_(scratch) {}

  void run() {
    clear();
    for (size_t row = 0; row < first_.count; ++row) {
      const bool meets = first_.time[row] <= 1;
      if (!meets) {
        write_nothing(row);
      } else if (is_point_at_mesh(row)) {
        add_triangle(row);
      } else if (is_composite(row)) {
        add_parts(row);
      } else {
        add_bodies(row);
      }
    }
    run_bodies();
    run_triangles();
    run_parts();
  }

 private:
  // Whether A is a point and B a mesh, and neither turns. Rays at meshes are common, and need less
  // than other parts.
  bool is_point_at_mesh(size_t row) const {
    const Pair pair = pairs_[row];
    return a_.body().kind(pair.a) == ShapeKind::sphere && a_.body().radius(pair.a) == 0 &&
           b_.body().kind(pair.b) == ShapeKind::mesh && a_.rotation_vector(pair.a).isZero(0) &&
           b_.rotation_vector(pair.b).isZero(0);
  }

  bool is_composite(size_t row) const {
    return carom::is_composite(a_.body().kind(pairs_[row].a)) ||
           carom::is_composite(b_.body().kind(pairs_[row].b));
  }

  void clear() {
    scratch_.a.clear();
    scratch_.b.clear();
    scratch_.count = 0;
    scratch_.triangles.clear();
    scratch_.parts.clear();
  }

  void write_nothing(size_t row) {
    if (out_.separation) out_.separation[row] = kNan;
    for (const std::array<float*, 3>& columns : {out_.normal, out_.point_a, out_.point_b}) {
      for (float* column : columns) {
        if (column) column[row] = kNan;
      }
    }
  }

  void add_bodies(size_t row) {
    scratch_.row[scratch_.count++] = static_cast<uint16_t>(row);
    // Positions are relative to A, so the contact does not depend on where both are.
    const Pair pair = pairs_[row];
    scratch_.a.put(a_, pair.a, {}, first_.time[row]);
    scratch_.b.put(b_, pair.b, place_between(a_, b_, pair), first_.time[row]);
  }

  void run_bodies() {
    if (scratch_.count == 0) return;
    const ResultColumns found =
        test(scratch_.a.view(side_a_.bodies), scratch_.b.view(side_b_.bodies), scratch_.count);
    for (size_t i = 0; i < scratch_.count; ++i) write(scratch_.row[i], found, i, {});
  }

  void add_triangle(size_t row) {
    const Pair pair = pairs_[row];
    const double t = first_.time[row];
    const Row orientation = b_.body().orientation(pair.b);
    const PlaceInTime point = place_at({}, {}, {}, a_, pair.a, t);
    const PlaceInTime mesh = place_at(place_between(a_, b_, pair), {}, orientation, b_, pair.b, t);
    scratch_.triangles.put(row, point.position, mesh.position, orientation,
                           *geometry_at<MeshGeometry>(b_.body().row(pair.b, 0)),
                           static_cast<uint32_t>(first_.parts[row][1]), side_b_.one_sided);
  }

  void run_triangles() {
    const TouchedTriangles& triangles = scratch_.triangles;
    if (triangles.count() == 0) return;
    const ResultColumns found = test(triangles.points(), triangles.triangles(), triangles.count());
    for (size_t i = 0; i < triangles.count(); ++i) write(triangles.row(i), found, i, {});
  }

  // Tests row i of A with row i of B.
  ResultColumns test(const Collidables& a, const Collidables& b, size_t count) {
    const ResultColumns found = scratch_.columns.columns();
    run_pair_block({.a = a,
                    .b = b,
                    .pairs = nullptr,
                    .first = 0,
                    .count = count,
                    .detail = Detail::contact,
                    .frame = WitnessFrame::body,
                    .accuracy = {},
                    .out = found});
    return found;
  }

  // Adds the two parts that meet. Positions are relative to A at the start.
  void add_parts(size_t row) {
    const PlacedBodies bodies(side_a_, side_b_, pairs_[row]);
    const size_t i = scratch_.parts.count();
    PlacedPart a = part_at(bodies.a, first_.parts[row][0]);
    PlacedPart b = part_at(bodies.b, first_.parts[row][1]);
    scratch_.arms[i] = {place(a, bodies.a.position, a_, pairs_[row].a, row),
                        place(b, bodies.b.position, b_, pairs_[row].b, row)};
    scratch_.parts.add(row, a, b, 0);
  }

  // Moves a part to its time of impact; `pivot` is its body's pivot at the start. Returns the arm
  // then.
  Double3 place(PlacedPart& part, const Double3& pivot, const MovingReader& side, size_t body,
                size_t row) {
    const PlaceInTime place =
        place_at(pivot, part.arm, part.orientation, side, body, first_.time[row]);
    part.position = place.position;
    part.orientation = place.orientation;
    part.turn = part.part->is_turned() ? rotation_of(place.orientation) : kNotTurned;
    return place.arm;
  }

  void run_parts() {
    scratch_.parts.run({});
    for (size_t i = 0; i < scratch_.parts.count(); ++i) {
      write(scratch_.parts.owner(i), scratch_.parts.results(), i, scratch_.arms[i]);
    }
  }

  // `arms`: from the bodies' positions at the time of impact to the origins of the found points.
  void write(size_t row, const ResultColumns& found, size_t i, std::array<Double3, 2> arms) {
    if (frame_ == WitnessFrame::world) {
      arms[0] = plus(position_then(a_, pairs_[row].a, first_.time[row]), arms[0]);
      arms[1] = plus(position_then(b_, pairs_[row].b, first_.time[row]), arms[1]);
    }
    if (out_.separation) out_.separation[row] = found.separation[i];
    for (size_t axis = 0; axis < 3; ++axis) {
      if (out_.normal[axis]) out_.normal[axis][row] = found.normal[axis][i];
      const auto seen = [&](const std::array<float*, 3>& points, double arm) {
        return static_cast<float>(points[axis][i] + arm);
      };
      if (out_.point_a[axis]) out_.point_a[axis][row] = seen(found.point_a, arms[0][axis]);
      if (out_.point_b[axis]) out_.point_b[axis][row] = seen(found.point_b, arms[1][axis]);
    }
  }

  static Double3 position_then(const MovingReader& side, size_t body, double t) {
    const Position<double> p = side.body().position<double>(body);
    const Position<float> d = side.displacement(body);
    return {p.x + d.x * t, p.y + d.y * t, p.z + d.z * t};
  }

  const MovingSide &side_a_, &side_b_;
  const MovingReader a_, b_;
  const Pair* pairs_;
  const FirstTimes first_;
  const WitnessFrame frame_;
  const ImpactColumns& out_;
  ContactScratch& scratch_;
};

}  // namespace

void find_impact_contacts(const MovingSide& a, const MovingSide& b, const Pair* pairs,
                          const FirstTimes& first, WitnessFrame frame, const ImpactColumns& out) {
  static thread_local const auto scratch = std::make_unique<ContactScratch>();
  ImpactContacts(a, b, pairs, first, frame, out, *scratch).run();
}

}  // namespace carom
