#include "tests/support/motions.h"

namespace carom::test {

MovedPair swapped(const MovedPair& pair) {
  return {swapped(pair.bodies), pair.sweep_b, pair.sweep_a};
}

template <class R>
MovingPair<R> moving_pair(const MovedPair& pair) {
  const auto& [a, b] = pair.bodies;
  return {a.shape, a.pose(), pair.sweep_a, b.shape, b.pose(), pair.sweep_b};
}

template MovingPair<double> moving_pair(const MovedPair& pair);
template MovingPair<long double> moving_pair(const MovedPair& pair);

Judgement judge(const MovedPair& pair, float toi) {
  const auto& [a, b] = pair.bodies;
  return judge_impact(a.shape, a.pose(), pair.sweep_a, b.shape, b.pose(), pair.sweep_b, toi);
}

Judgement judge_bound(const MovedPair& pair, float toi) {
  const auto moving = moving_pair<long double>(pair);
  return ImpactJudge<long double>(moving).late(toi);
}

ImpactBracket<double> impact(const MovedPair& pair) {
  const ImpactBracket<double> found = bracket_impact(moving_pair<double>(pair));
  if (found.meeting != Meeting::unknown) return found;
  const auto wide = bracket_impact(moving_pair<long double>(pair));
  return {wide.meeting, static_cast<double>(wide.low), static_cast<double>(wide.high)};
}

std::string show(const MovedPair& pair) {
  const auto text = [](const PlacedShape& body, const Sweep& sweep) {
    return show(body) + "\n  moves by " + hex3(sweep.displacement) + " turns by " +
           hex3(sweep.rotation);
  };
  return text(pair.bodies.a, pair.sweep_a) + "\n" + text(pair.bodies.b, pair.sweep_b);
}

void PrintTo(const MotionFamily& family, std::ostream* out) { *out << family.name; }

std::vector<MotionFamily> plain_motions() {
  using enum PositionType;
  return {
      {.name = "plain"},
      {.name = "turning", .positions = float64, .most_turn = 2},
  };
}

std::vector<MotionFamily> hard_motions() {
  using enum MotionPlan;
  using enum PositionType;
  return {
      {.name = "turning often", .most_turn = 50},
      {.name = "far", .positions = float64, .most_turn = 1, .distance = 1e9},
      {.name = "far in float32", .distance = 1e4},
      {.name = "tiny", .smallest = 1e-30, .largest = 1e-28, .most_turn = 1},
      {.name = "huge", .positions = float64, .smallest = 1e17, .largest = 1e18, .most_turn = 1},
      {.name = "sizes", .positions = float64, .smallest = 1e-30, .largest = 1e18},
      {.name = "ratio", .positions = float64, .ratio = 1e6, .most_turn = 1},
      {.name = "thin", .positions = float64, .aspect = 1e6, .most_turn = 1},
      {.name = "degenerate", .positions = float64, .most_turn = 1, .degenerate = true},
      {.name = "fast", .positions = float64, .least_travel = 1e5, .most_travel = 1e6},
      {.name = "beyond bounds", .least_travel = 1e17, .most_travel = 1e18, .most_turn = 1},
      {.name = "slow", .plan = touching, .least_travel = 1e-9, .most_travel = 1e-3},
      {.name = "subnormal", .plan = touching, .least_travel = 1e-45, .most_travel = 1e-38},
      {.name = "still", .most_travel = 0},
      {.name = "still and touching", .plan = touching, .positions = float64, .most_travel = 0},
      {.name = "grazing", .plan = grazing, .positions = float64},
      {.name = "grazing and turning", .plan = grazing, .positions = float64, .most_turn = 2},
      {.name = "grazing flat", .plan = grazing, .positions = float64, .near_parallel = true},
      {.name = "sliding", .plan = sliding, .positions = float64},
      {.name = "sliding flat", .plan = sliding, .positions = float64, .near_parallel = true},
      {.name = "sliding and turning", .plan = sliding, .positions = float64, .most_turn = 1},
      {.name = "touching", .plan = touching, .positions = float64, .most_turn = 1},
      {.name = "touching in float32", .plan = touching, .distance = 10},
      {.name = "parting", .plan = parting, .positions = float64},
      {.name = "coincident", .plan = coincident, .most_turn = 1},
      {.name = "coincident and still", .plan = coincident, .most_travel = 0},
      {.name = "parallel", .positions = float64, .near_parallel = true},
      {.name = "turning alone", .plan = touching, .most_travel = 0, .most_turn = 2},
      {.name = "spinning alone", .plan = touching, .most_travel = 0, .most_turn = 50},
      {.name = "turning on the contact",
       .plan = touching,
       .positions = float64,
       .most_travel = 0,
       .most_turn = 6,
       .through_contact = true},
      {.name = "crossing edges",
       .plan = crossing,
       .positions = float64,
       .least_travel = 1e-3,
       .most_travel = 1,
       .most_turn = 2},
      {.name = "crossing edges that spin",
       .plan = crossing,
       .positions = float64,
       .least_travel = 1e-3,
       .most_travel = 10,
       .most_turn = 30},
      {.name = "crossing edges nearly parallel",
       .plan = crossing,
       .positions = float64,
       .least_travel = 1e-3,
       .most_travel = 1,
       .most_turn = 2,
       .near_parallel = true,
       .turn_together = true},
  };
}

MotionMaker::MotionMaker(const MotionFamily& family, KindPair kinds, uint64_t seed)
    : family_(family),
      kinds_(kinds),
      random_(seed),
      shapes_({.aspect = family.aspect,
               .degenerate = family.degenerate,
               .aligned = family.near_parallel},
              random_) {}

MovedPair MotionMaker::next() {
  make_bodies();
  make_sweeps();
  switch (family_.plan) {
    case MotionPlan::aimed:
      aim(random_.chance(0.25) ? 0 : most_miss());
      break;
    case MotionPlan::grazing:
      aim(1);
      graze();
      break;
    case MotionPlan::sliding:
      place_near(near_gap());
      move(tangent() + normal() * sign() * random_.log_uniform(1e-9, 1e-2));
      break;
    case MotionPlan::touching:
      place_near(near_gap());
      break;
    case MotionPlan::parting:
      place_near(random_.log_uniform(1e-6, 1));
      move(tangent() + normal() * random_.log_uniform(1e-6, 10));
      break;
    case MotionPlan::coincident:
      break;
    case MotionPlan::crossing:
      cross_edges();
      break;
  }
  if (family_.through_contact) turn_on_contact();
  return pair_;
}

bool MotionMaker::is_plane(const PlacedShape& body) const {
  return std::holds_alternative<Halfspace>(body.shape);
}

void MotionMaker::make_bodies() {
  const Shapes& shapes = some_shapes();
  size_ = shapes.size;
  pair_ = {};
  a().shape = shapes.a;
  b().shape = shapes.b;
  a().orientation = shapes_.orientation();
  b().orientation =
      family_.near_parallel ? turned_a_little(a().orientation) : shapes_.orientation();
  a().position = stored(random_.direction() * family_.distance * size_);
  b().position = a().position;
}

const MotionMaker::Shapes& MotionMaker::some_shapes() {
  constexpr size_t kEnough = 256;
  const bool is_full = stock_.size() == kEnough;
  if (is_full && random_.chance(0.95)) return stock_[random_.below(kEnough)];
  if (!is_full) stock_.emplace_back();
  Shapes& shapes = is_full ? stock_[random_.below(kEnough)] : stock_.back();
  const double size_a = random_.log_uniform(family_.smallest, family_.largest);
  const double size_b = size_a * random_.log_uniform(1 / family_.ratio, family_.ratio);
  shapes = {shapes_.shape(kinds_.a, size_a), shapes_.shape(kinds_.b, size_b),
            std::max(size_a, size_b)};
  return shapes;
}

Eigen::Quaternionf MotionMaker::turned_a_little(const Eigen::Quaternionf& q) {
  constexpr double kAngles[] = {0, 1e-8, 1e-4};
  const Vec v = random_.direction() * (kAngles[random_.below(3)] / 2);
  const Eigen::Quaterniond little(1, v.x(), v.y(), v.z());
  return (q.cast<double>() * little).cast<float>();
}

void MotionMaker::make_sweeps() {
  for (Sweep* sweep : {&pair_.sweep_a, &pair_.sweep_b}) {
    if (random_.chance(0.7)) sweep->rotation = turn().cast<float>();
  }
  if (family_.turn_together) {
    const Eigen::Vector3f& both = pair_.sweep_a.rotation;
    const Vec change = random_.direction() * both.norm() * random_.log_uniform(1e-6, 1);
    pair_.sweep_b.rotation = both + change.cast<float>();
  }
  if (family_.most_travel == 0) return;
  move(random_.direction() * random_.log_uniform(family_.least_travel, family_.most_travel));
}

void MotionMaker::move(const Vec& way) {
  const double share = random_.chance(0.5) ? 0 : random_.uniform(-1, 1);
  const Vec both = random_.direction() * way.norm() * share * size_;
  pair_.sweep_a.displacement = both.cast<float>();
  pair_.sweep_b.displacement = (both + way * size_).cast<float>();
}

Eigen::Vector3d MotionMaker::velocity() const {
  return (pair_.sweep_b.displacement.cast<double>() - pair_.sweep_a.displacement.cast<double>());
}

double MotionMaker::most_miss() const {
  return kinds_.a == ShapeKind::sphere || kinds_.b == ShapeKind::sphere ? 2.5 : 1.5;
}

void MotionMaker::aim(double miss) {
  const bool has_plane = is_plane(a()) || is_plane(b());
  if (has_plane) move_inwards();
  const double t = family_.most_travel == 0 ? 0 : random_.uniform(0.1, has_plane ? 2.5 : 1);
  const Vec on_a = point_in(a(), pair_.sweep_a, t), on_b = point_in(b(), pair_.sweep_b, t);
  const Vec beside = random_.direction() * random_.uniform(0, miss) * reach();
  b().position = stored(a().position + on_a - on_b - velocity() * t + beside);
}

void MotionMaker::move_inwards() {
  const Vec out = is_plane(a()) ? plane_normal(a()) : -plane_normal(b());
  if (out.dot(velocity()) > 0) std::swap(pair_.sweep_a.displacement, pair_.sweep_b.displacement);
}

double MotionMaker::reach() const {
  double sum = 0;
  for (const PlacedShape* body : {&pair_.bodies.a, &pair_.bodies.b}) {
    const MovingShape<double> shape(body->shape, body->pose(), Sweep{});
    if (!shape.is_halfspace()) sum += shape.bounding_radius();
  }
  return sum;
}

Eigen::Vector3d MotionMaker::point_in(const PlacedShape& body, const Sweep& sweep, double t) {
  const MovingShape<double> shape(body.shape, body.pose(), sweep);
  Vec point = random_.direction() * size_;
  if (shape.is_halfspace()) {
    const Vec n = eigen(shape.normal());
    point += n * (shape.offset() - n.dot(point));
  } else {
    const auto corner = [&] { return eigen(shape.points()[random_.below(shape.points().size())]); };
    const Vec from = corner();
    point = from + (corner() - from) * random_.uniform(0, 1);
  }
  return eigen(shape.turn(t)({point.x(), point.y(), point.z()}));
}

double MotionMaker::near_gap() {
  if (random_.chance(0.2)) return 0;
  const double size = random_.chance(0.3) ? 1e-6 : random_.log_uniform(1e-12, 1e-3);
  return random_.chance(0.8) ? size : -size;
}

void MotionMaker::place_near(double gap) {
  b().position = a().position + way_out(2 * reach() + size_);
  pull(0, gap);
}

void MotionMaker::pull(double until, double gap) {
  const MovingPair<double> moving = moving_pair<double>(pair_);
  const LeastSeparation<double> least = least_separation<double>(moving, 0, until);
  normal_ = eigen(least.normal) * (moving.is_swapped() ? -1 : 1);
  b().position = stored(b().position - normal_ * (least.value - gap * size_));
}

Eigen::Vector3d MotionMaker::way_out(double reach) {
  const Vec any = random_.direction() * reach;
  if (is_plane(a())) return any * 0.9 + out_of(a(), 2 * reach);
  if (is_plane(b())) return any * 0.9 - out_of(b(), 2 * reach);
  return any;
}

Eigen::Vector3d MotionMaker::out_of(const PlacedShape& plane, double height) {
  const MovingShape<double> shape(plane.shape, plane.pose(), Sweep{});
  return plane_normal(plane) * (shape.offset() + height);
}

Eigen::Vector3d MotionMaker::plane_normal(const PlacedShape& plane) {
  return eigen(MovingShape<double>(plane.shape, plane.pose(), Sweep{}).normal());
}

void MotionMaker::graze() {
  const Vec v = velocity();
  Vec way = way_out(2 * reach() + v.norm());
  if (is_plane(a()) || is_plane(b())) {
    b().position = a().position + way;
  } else {
    if (v.norm() > 0) way -= v.normalized() * v.normalized().dot(way);
    b().position += way;
  }
  pull(1, 0);
  pull(1, sign() * random_.log_uniform(1e-12, 1e-3));
}

Eigen::Vector3d MotionMaker::tangent() {
  const double travel = random_.log_uniform(family_.least_travel, family_.most_travel);
  const Vec any = random_.direction() * travel;
  return any - normal_ * normal_.dot(any);
}

void MotionMaker::cross_edges() {
  if (is_plane(a()) || is_plane(b())) return aim(most_miss());
  const double t = random_.uniform(0.1, 1);
  const MovingShape<double> shape_a(a().shape, a().pose(), pair_.sweep_a);
  const MovingShape<double> shape_b(b().shape, b().pose(), pair_.sweep_b);
  const TurnedShape<double> turned_a(shape_a, t), turned_b(shape_b, t);
  normal_ = random_.direction();
  Vec edge_a = Vec::Zero(), edge_b = Vec::Zero();
  const auto way = [&](double sign) -> Vec3<double> {
    return {sign * normal_.x(), sign * normal_.y(), sign * normal_.z()};
  };
  for (int i = 0; i < 4; ++i) {  // after a few rounds the normal mostly points out of both edges
    edge_a = eigen(turned_a.ridge(way(1)));
    edge_b = eigen(turned_b.ridge(way(-1)));
    const Vec across = edge_a.cross(edge_b);
    if (!(across.norm() > 0)) break;
    normal_ = across.normalized() * (across.dot(normal_) < 0 ? -1 : 1);
  }
  const Vec on_a = eigen(turned_a.corner(way(1))) + edge_a * random_.uniform(0, 1);
  const Vec on_b = eigen(turned_b.corner(way(-1))) + edge_b * random_.uniform(0, 1);
  move(tangent() - normal() * random_.log_uniform(1e-6, 1));
  const Vec apart = normal() * (shape_a.radius() + shape_b.radius() + near_gap() * size_);
  b().position = stored(a().position + (on_a - on_b) + apart - velocity() * t);
}

void MotionMaker::turn_on_contact() {
  const MovingShape<double> shape(b().shape, b().pose(), Sweep{});
  const TurnedShape<double> turned(shape, 0.0);
  if (shape.is_halfspace()) return;
  const Vec contact = eigen(turned.corner({-normal_.x(), -normal_.y(), -normal_.z()}));
  const Vec arm = contact - normal_ * shape.radius();
  if (!(arm.norm() > 0)) return;
  pair_.sweep_a.rotation.setZero();
  pair_.sweep_b.rotation = (arm.normalized() * family_.most_turn).cast<float>();
}

std::vector<MovedPair> make_motions(const MotionFamily& family, const KindPair& kinds, size_t count,
                                    uint64_t seed) {
  MotionMaker maker(family, kinds, seed);
  std::vector<MovedPair> pairs;
  for (size_t i = 0; i < count; ++i) pairs.push_back(maker.next());
  return pairs;
}

}  // namespace carom::test
