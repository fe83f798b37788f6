#include "impacts/impact_contacts.h"

#include <array>
#include <limits>
#include <memory>
#include <optional>

#include "geometries/mesh_memory.h"
#include "impacts/composite_times.h"
#include "impacts/moving_body.h"
#include "impacts/rays/point_contact.h"
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
    dops_[count_] = reader.dop_geometry(body);
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
    view.dops = dops_.data();
    return view;
  }

 private:
  size_t count_ = 0;
  alignas(64) std::array<std::array<double, 4>, kPairsPerBlock> record_;
  std::array<Row, kPairsPerBlock> orientation_;
  std::array<ShapeKind, kPairsPerBlock> kind_;
  std::array<const DopGeometry*, kPairsPerBlock> dops_;
  std::array<uint32_t, kPairsPerBlock> first_row_, box_slot_;
};

struct ContactScratch {
  PlacedSide a, b;
  size_t count;
  std::array<uint16_t, kPairsPerBlock> row;  // of every placed pair
  TestColumns columns;
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
      prefetch(row);
      const bool meets = first_.time[row] <= 1;
      if (!meets) {
        write_nothing(row);
      } else if (is_point_at_mesh(row)) {
        take_triangle(row);
      } else if (is_composite(row)) {
        add_parts(row);
      } else {
        add_bodies(row);
      }
    }
    run_bodies();
    run_parts();
  }

 private:
  // Whether A is a point and B a mesh, and neither turns. Rays at meshes are common, and need less
  // than other parts.
  bool is_point_at_mesh(size_t row) const {
    const Pair pair = pairs_[row];
    return a_.body().kind(pair.a) == ShapeKind::sphere && a_.body().radius(pair.a) == 0 &&
           b_.body().kind(pair.b) == ShapeKind::mesh && !a_.turns(pair.a) && !b_.turns(pair.b);
  }

  bool is_composite(size_t row) const {
    return carom::is_composite(a_.body().kind(pairs_[row].a)) ||
           carom::is_composite(b_.body().kind(pairs_[row].b));
  }

  void clear() {
    scratch_.a.clear();
    scratch_.b.clear();
    scratch_.count = 0;
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

  void take_triangle(size_t row) {
    const Pair pair = pairs_[row];
    const double t = first_.time[row];
    const Double3 between = place_between(a_, b_, pair), way = way_between(a_, b_, pair);
    const Row orientation = b_.body().orientation(pair.b);
    if (orientation != last_orientation_) {
      last_orientation_ = orientation;
      last_turn_ = rotation_of(orientation);
    }
    scalar::Separation found;
    find_point_contact({.mesh = mesh_of(row),
                        .place = plus(between, {way[0] * t, way[1] * t, way[2] * t}),
                        .orientation = orientation,
                        .turn = last_turn_,
                        .one_sided = side_b_.one_sided},
                       triangle_of(row), found);
    write(row, found, {});
  }

  const MeshGeometry& mesh_of(size_t row) const {
    return *geometry_at<MeshGeometry>(b_.body().row(pairs_[row].b, 0));
  }
  uint32_t triangle_of(size_t row) const { return static_cast<uint32_t>(first_.parts[row][1]); }

  // Triangles that rays meet lie far apart in memory.
  void prefetch(size_t row) const {
    constexpr size_t kIndicesAhead = 16, kCornersAhead = 8;
    const auto takes = [&](size_t i) {
      return first_.time[i] <= 1 && b_.body().kind(pairs_[i].b) == ShapeKind::mesh;
    };
    if (row + kIndicesAhead < first_.count && takes(row + kIndicesAhead)) {
      prefetch_indices(mesh_of(row + kIndicesAhead), triangle_of(row + kIndicesAhead));
    }
    if (row + kCornersAhead < first_.count && takes(row + kCornersAhead)) {
      prefetch_corners(mesh_of(row + kCornersAhead), triangle_of(row + kCornersAhead));
    }
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

  void write(size_t row, const ResultColumns& found, size_t i, const std::array<Double3, 2>& arms) {
    const auto vector = [i](const std::array<float*, 3>& columns) -> Eigen::Vector3f {
      return {columns[0][i], columns[1][i], columns[2][i]};
    };
    write(row,
          {.separation = found.separation[i],
           .normal = vector(found.normal),
           .arm_a = vector(found.point_a),
           .arm_b = vector(found.point_b)},
          arms);
  }

  // `arms`: from the bodies' positions at the time of impact to the origins of the found points.
  void write(size_t row, const scalar::Separation& found, const std::array<Double3, 2>& arms) {
    if (frame_ == WitnessFrame::body) return write_about(row, found, arms[0], arms[1]);
    const auto then = [this, row](const MovingReader& side, size_t body, const Double3& arm) {
      return plus(position_then(side, body, first_.time[row]), arm);
    };
    write_about(row, found, then(a_, pairs_[row].a, arms[0]), then(b_, pairs_[row].b, arms[1]));
  }

  void write_about(size_t row, const scalar::Separation& found, const Double3& arm_a,
                   const Double3& arm_b) {
    if (out_.separation) out_.separation[row] = found.separation;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<int>(axis);
      const auto seen = [](float point, double arm) { return static_cast<float>(point + arm); };
      if (out_.normal[axis]) out_.normal[axis][row] = found.normal[i];
      if (out_.point_a[axis]) out_.point_a[axis][row] = seen(found.arm_a[i], arm_a[axis]);
      if (out_.point_b[axis]) out_.point_b[axis][row] = seen(found.arm_b[i], arm_b[axis]);
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

  // Rays mostly meet one mesh after another.
  Row last_orientation_{};  // none that a mesh can have
  Turn last_turn_;
};

}  // namespace

void find_impact_contacts(const MovingSide& a, const MovingSide& b, const Pair* pairs,
                          const FirstTimes& first, WitnessFrame frame, const ImpactColumns& out) {
  static thread_local const auto scratch = std::make_unique_for_overwrite<ContactScratch>();
  ImpactContacts(a, b, pairs, first, frame, out, *scratch).run();
}

}  // namespace carom
