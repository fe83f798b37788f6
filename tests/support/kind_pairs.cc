#include "tests/support/kind_pairs.h"

#include "tests/support/textbook.h"

namespace carom::test {

std::vector<KindPair> supported_kind_pairs() {
  std::vector<KindPair> all = solved_kind_pairs();
  for (const KindPair& kinds : round_kind_pairs()) {
    if (supports(kinds.a, kinds.b)) all.push_back(kinds);
  }
  return all;
}

std::vector<KindPair> solved_kind_pairs() {
  std::vector<KindPair> all;
  for (const ShapeKind a : kConvexKinds) {
    for (const ShapeKind b : kConvexKinds) {
      if (supports(a, b)) all.push_back({a, b});
    }
  }
  return all;
}

std::string family_name(const testing::TestParamInfo<ConvexFamily>& info) {
  std::string text = info.param.name;
  const auto is_other = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; };
  std::replace_if(text.begin(), text.end(), is_other, '_');
  return text;
}

bool has_halfspace(const KindPair& kinds) {
  return kinds.a == ShapeKind::halfspace || kinds.b == ShapeKind::halfspace;
}

TestPair as_test_pair(const ConvexPair& pair) {
  return {{pair.shape_a, pair.pose_a.position, pair.pose_a.orientation},
          {pair.shape_b, pair.pose_b.position, pair.pose_b.orientation}};
}

std::vector<TestPair> make_kind_pairs(const ConvexFamily& family, const KindPair& kinds,
                                      PositionType positions, size_t count, uint64_t seed) {
  std::vector<TestPair> pairs;
  ConvexPairMaker maker(family, kinds, positions, seed);
  for (size_t i = 0; i < count; ++i) pairs.push_back(as_test_pair(maker.next()));
  return pairs;
}

std::vector<TestPair> make_mixed_kind_pairs(const ConvexFamily& family, PositionType positions,
                                            size_t count, uint64_t seed,
                                            std::vector<KindPair> kinds) {
  std::erase_if(kinds, [](const KindPair& each) { return each.a == ShapeKind::halfspace; });
  Random random(seed);
  std::vector<TestPair> pairs;
  for (size_t i = 0; i < count; ++i) {
    KindPair some = kinds[random.below(kinds.size())];
    while (fewer_if_slow(some, 2) < 2 && random.chance(0.9))
      some = kinds[random.below(kinds.size())];
    pairs.push_back(make_kind_pairs(family, some, positions, 1, random.bits())[0]);
  }
  return pairs;
}

void round_some(std::vector<TestPair>& pairs, uint64_t seed) {
  Random random(seed);
  for (TestPair& pair : pairs) {
    for (PlacedShape* body : {&pair.a, &pair.b}) {
      if (!is_round(kind_of(body->shape)) || !random.chance(0.25)) continue;
      std::visit(
          [&](auto& shape) {
            if constexpr (requires { shape.rounding; }) {
              const double size = bounding_radius(Shape(shape));
              shape.rounding = static_cast<float>(size * random.log_uniform(1e-3, 1));
            }
          },
          body->shape);
    }
  }
}

std::vector<TestPair> make_pairs_of_families(const KindPair& kinds, PositionType positions,
                                             size_t count_each, uint64_t seed) {
  std::vector<TestPair> pairs;
  for (const ConvexFamily& family : convex_families()) {
    for (const TestPair& pair : make_kind_pairs(family, kinds, positions, count_each, seed)) {
      pairs.push_back(pair);
    }
  }
  return pairs;
}

void Spoiler::spoil(TestPair& pair) {
  spoil(pair.a);
  spoil(pair.b);
}

void Spoiler::spoil(PlacedShape& body) {
  for (int i = 0; i < 3; ++i) {
    if (random_.chance(0.1)) body.position[i] = random_.any_float();
  }
  for (int i = 0; i < 4; ++i) spoil(body.orientation.coeffs()[i]);
  std::visit([this](auto& shape) { spoil_shape(shape); }, body.shape);
}

void Spoiler::spoil(float& x) {
  if (random_.chance(0.1)) x = random_.any_float();
}

void Spoiler::spoil(Eigen::Vector3f& v) {
  for (int i = 0; i < 3; ++i) spoil(v[i]);
}

void Spoiler::spoil_size(float& x) {
  spoil(x);
  if (random_.chance(0.9)) x = std::fabs(x);
}

void Spoiler::spoil_rounding(float& x) {
  if (x == 0) return;
  const float before = x;
  spoil_size(x);
  if (x == 0) x = before;
}

void Spoiler::spoil_shape(Aabb& box) {
  spoil(box.lower);
  spoil(box.upper);
  for (int i = 0; i < 3; ++i) {
    if (box.lower[i] > box.upper[i] && random_.chance(0.9)) std::swap(box.lower[i], box.upper[i]);
  }
}

void Spoiler::spoil_shape(Capsule& capsule) {
  spoil(capsule.a);
  spoil(capsule.b);
  spoil_size(capsule.radius);
}

void Spoiler::spoil_shape(Box& box) {
  for (int i = 0; i < 3; ++i) spoil_size(box.half[i]);
  spoil_rounding(box.rounding);
}

void Spoiler::spoil_shape(Cylinder& cylinder) {
  spoil_size(cylinder.radius);
  spoil_size(cylinder.half_length);
  spoil_rounding(cylinder.rounding);
}

void Spoiler::spoil_shape(Cone& cone) {
  spoil_size(cone.radius);
  spoil_size(cone.half_length);
  spoil_rounding(cone.rounding);
}

void Spoiler::spoil_shape(Ellipsoid& ellipsoid) {
  for (int i = 0; i < 3; ++i) spoil_size(ellipsoid.semi_axes[i]);
  spoil_rounding(ellipsoid.rounding);
}

void Spoiler::spoil_shape(Triangle& triangle) {
  for (Eigen::Vector3f& corner : triangle.corners) spoil(corner);
  spoil_size(triangle.thickness);
  triangle.one_sided = random_.chance(0.5);
  triangle.inner_edges = static_cast<uint8_t>(random_.below(random_.chance(0.95) ? 8 : 256));
}

void Spoiler::spoil_shape(Halfspace& halfspace) {
  spoil(halfspace.normal);
  spoil(halfspace.offset);
  if (random_.chance(0.02)) halfspace.normal.setZero();
}

void Spoiler::spoil_shape(Dop& dop) {
  if (random_.chance(0.7)) return;
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    if (random_.chance(0.9)) continue;
    spoil(dop.lower[i]);
    spoil(dop.upper[i]);
    if (random_.chance(0.9))
      std::tie(dop.lower[i], dop.upper[i]) = std::minmax({dop.lower[i], dop.upper[i]});
  }
  if (random_.chance(0.05)) dop.kind = static_cast<DopKind>(random_.below(256));
}

void Spoiler::spoil_shape(Hull& hull) {
  spoil_rounding(hull.rounding);
  if (random_.chance(0.02)) hull.geometry = nullptr;
  if (!hull.geometry || random_.chance(0.5)) return;
  hull = with_points(hull, [this](Eigen::Vector3f& point) {
    const Eigen::Vector3f before = point;
    spoil(point);
    if (!point.allFinite()) point = before;
  });
}

std::vector<TestPair> make_kind_nonsense(const KindPair& kinds, size_t count, uint64_t seed) {
  std::vector<TestPair> pairs =
      make_kind_pairs({.name = ""}, kinds, PositionType::float32, count, seed);
  Spoiler spoiler(seed);
  for (TestPair& pair : pairs) spoiler.spoil(pair);
  return pairs;
}

void vary_triangles(std::vector<TestPair>& pairs, uint64_t seed) {
  Random random(seed);
  for (TestPair& pair : pairs) {
    for (PlacedShape* body : {&pair.a, &pair.b}) {
      if (auto* triangle = std::get_if<Triangle>(&body->shape)) {
        triangle->one_sided = random.chance(0.5);
        triangle->inner_edges = static_cast<uint8_t>(random.below(8));
      }
    }
  }
}

}  // namespace carom::test
