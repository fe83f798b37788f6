#include "tests/support/families.h"

namespace carom::test {

const char* name(Sides sides) {
  constexpr const char* kNames[] = {"sphere_sphere", "point_sphere", "sphere_aabb",
                                    "aabb_sphere",   "point_aabb",   "aabb_aabb"};
  return kNames[static_cast<int>(sides)];
}

std::vector<Family> families() {
  std::vector<Family> all = {
      {.name = "plain"},
      {.name = "at 1e3", .distance = 1e3},
      {.name = "at 1e6", .smallest = 0.5, .largest = 1e3, .distance = 1e6},
      {.name = "at 1e9", .smallest = 0.5, .largest = 1e6, .distance = 1e9},
      {.name = "sizes", .smallest = 1e-30, .largest = 1e18, .distance_in_sizes = true},
      {.name = "ratio", .ratio = 1e10},
      {.name = "aspect", .aspect = 1e6},
      {.name = "touch", .distance = 0, .placement = Placement::near_touch},
      {.name = "touch at 1e3", .distance = 1e3, .placement = Placement::near_touch},
      {.name = "touch of all sizes",
       .smallest = 1e-30,
       .largest = 1e18,
       .ratio = 1e3,
       .distance = 0,
       .placement = Placement::near_touch},
      {.name = "coincident", .placement = Placement::coincident},
      {.name = "coincident at 1e9", .distance = 1e9, .placement = Placement::coincident},
      {.name = "lattice", .placement = Placement::lattice},
      {.name = "lattice of subnormals",
       .smallest = 0x1p-140,
       .largest = 0x1p-140,
       .placement = Placement::lattice},
      {.name = "degenerate", .degenerate = true},
      {.name = "degenerate touch",
       .distance = 0,
       .placement = Placement::near_touch,
       .degenerate = true},
      {.name = "subnormal", .smallest = 1e-44, .largest = 1e-36, .distance_in_sizes = true},
  };
  return all;
}

TestPair PairMaker::next() {
  TestPair pair;
  const double size = random_.log_uniform(family_.smallest, family_.largest);
  const double size_b = size * random_.log_uniform(1 / family_.ratio, family_.ratio);
  pair.a.shape =
      shape(is_box_a(), sides_ == Sides::point_sphere || sides_ == Sides::point_aabb, size);
  pair.b.shape = shape(is_box_b(), false, size_b);
  if (family_.placement == Placement::lattice) {
    place_on_lattice(pair);
  } else {
    place(pair, size);
  }
  return pair;
}

bool PairMaker::is_box_b() const {
  return sides_ == Sides::sphere_aabb || sides_ == Sides::point_aabb || sides_ == Sides::aabb_aabb;
}

Shape PairMaker::shape(bool is_box, bool is_point, double size) {
  const bool lattice = family_.placement == Placement::lattice;
  if (!is_box) {
    const bool zero = is_point || (family_.degenerate && random_.chance(0.5));
    const double radius = lattice ? family_.smallest * (1 + random_.below(5)) / 2 : size;
    return Sphere{zero ? 0.0f : static_cast<float>(radius)};
  }
  Aabb box;
  const bool off_centre = random_.chance(0.5);
  for (int i = 0; i < 3; ++i) {
    double half = size * random_.log_uniform(1 / family_.aspect, 1);
    double shift = off_centre ? random_.uniform(-size, size) : 0;
    if (lattice) {
      half = family_.smallest * random_.below(3);
      shift = off_centre ? family_.smallest * (static_cast<double>(random_.below(3)) - 1) : 0;
    }
    if (family_.degenerate && random_.chance(0.4)) half = 0;
    box.lower[i] = static_cast<float>(shift - half);
    box.upper[i] = static_cast<float>(shift + half);
  }
  return box;
}

void PairMaker::place_on_lattice(TestPair& pair) {
  for (PlacedShape* body : {&pair.a, &pair.b}) {
    for (int i = 0; i < 3; ++i) {
      body->position[i] = family_.smallest * (static_cast<double>(random_.below(7)) - 3);
    }
  }
}

void PairMaker::place(TestPair& pair, double size) {
  const double distance = family_.distance * (family_.distance_in_sizes ? size : 1);
  pair.a.position = stored(random_.direction() * distance, positions_);
  pair.b.position = pair.a.position;
  if (family_.placement == Placement::coincident) return;

  const Eigen::Vector3d start = common_centre(pair);
  const Eigen::Vector3d direction = way(pair);
  const double touch = distance_to_touch(pair, start, direction);
  const double factor =
      family_.placement == Placement::near_touch ? near_one() : random_.uniform(0, 2);
  pair.b.position = stored(pair.a.position + start + direction * (touch * factor), positions_);
  if (family_.placement == Placement::near_touch) nudge(pair);
}

Eigen::Vector3d PairMaker::common_centre(const TestPair& pair) {
  const RoundedBox a = rounded_box(pair.a.shape);
  const RoundedBox b = rounded_box(pair.b.shape);
  return (a.lower + a.upper - b.lower - b.upper) / 2;
}

Eigen::Vector3d PairMaker::way(const TestPair& pair) {
  Eigen::Vector3d direction = random_.direction();
  if (random_.chance(0.5)) return direction;
  const RoundedBox a = rounded_box(pair.a.shape);
  const RoundedBox b = rounded_box(pair.b.shape);
  const Eigen::Vector3d extent = a.upper - a.lower + b.upper - b.lower;
  direction = direction.cwiseProduct((extent / 2).array().matrix() +
                                     Eigen::Vector3d::Constant(a.radius + b.radius));
  const double length = direction.stableNorm();
  return length > 0 ? (direction / length).eval() : random_.direction();
}

double PairMaker::distance_to_touch(const TestPair& pair, const Eigen::Vector3d& start,
                                    const Eigen::Vector3d& direction) {
  double low = 0;
  double high = 4 * (bounding_radius(pair.a.shape) + bounding_radius(pair.b.shape));
  for (int i = 0; i < 64; ++i) {
    const double middle = (low + high) / 2;
    const bool apart =
        textbook_separation(pair.a.shape, pair.b.shape, start + direction * middle) > 0;
    (apart ? high : low) = middle;
  }
  return high;
}

void PairMaker::nudge(TestPair& pair) {
  double& x = pair.b.position[random_.below(3)];
  const double towards = random_.chance(0.5) ? 1e300 : -1e300;
  for (uint64_t steps = random_.below(5); steps > 0; --steps) {
    x = positions_ == PositionType::float64
            ? std::nextafter(x, towards)
            : std::nextafter(static_cast<float>(x),
                             static_cast<float>(
                                 std::copysign(std::numeric_limits<float>::infinity(), towards)));
  }
}

std::vector<TestPair> make_pairs(const Family& family, Sides sides, PositionType positions,
                                 size_t count, uint64_t seed) {
  PairMaker maker(family, sides, positions, seed);
  std::vector<TestPair> pairs;
  for (size_t i = 0; i < count; ++i) pairs.push_back(maker.next());
  return pairs;
}

std::vector<TestPair> make_nonsense(Sides sides, size_t count, uint64_t seed) {
  std::vector<TestPair> pairs = make_pairs({.name = ""}, sides, PositionType::float32, count, seed);
  Random random(seed);
  const auto spoil = [&](float& x) {
    if (random.chance(0.2)) x = random.any_float();
  };
  for (TestPair& pair : pairs) {
    for (PlacedShape* body : {&pair.a, &pair.b}) {
      for (int i = 0; i < 3; ++i) {
        if (random.chance(0.2)) body->position[i] = random.any_float();
      }
      if (auto* sphere = std::get_if<Sphere>(&body->shape)) {
        spoil(sphere->radius);
        if (random.chance(0.8)) sphere->radius = std::fabs(sphere->radius);
      } else {
        Aabb& box = std::get<Aabb>(body->shape);
        for (int i = 0; i < 3; ++i) {
          spoil(box.lower[i]);
          spoil(box.upper[i]);
          if (box.lower[i] > box.upper[i] && random.chance(0.9)) {
            std::swap(box.lower[i], box.upper[i]);
          }
        }
      }
    }
  }
  return pairs;
}

}  // namespace carom::test
