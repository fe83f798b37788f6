#include "tests/support/boxes.h"

namespace carom::test {

bool overlap(const TestBox& a, const TestBox& b) {
  for (int i = 0; i < 3; ++i) {
    // NaN and inverted boxes fail this comparison.
    if (!(a.lower[i] <= a.upper[i] && b.lower[i] <= b.upper[i])) return false;
    if (!(a.lower[i] <= b.upper[i] && b.lower[i] <= a.upper[i])) return false;
  }
  return true;
}

LaidOutBoxes::LaidOutBoxes(const Boxes& boxes, size_t record) {
  const bool dense = record == 0;
  const size_t element = dense ? sizeof(float) : sizeof(TestBox);
  for (int i = 0; i < (dense ? 6 : 1); ++i) {
    memory_.emplace_back(boxes.size(), element, dense ? sizeof(float) : record);
  }
  for (size_t i = 0; i < boxes.size(); ++i) {
    if (!dense) memory_[0].set(i, boxes[i]);
    for (int axis = 0; dense && axis < 3; ++axis) {
      memory_[axis].set(i, boxes[i].lower[axis]);
      memory_[3 + axis].set(i, boxes[i].upper[axis]);
    }
  }
  const auto column = [&](int i) -> const float* {
    return dense ? memory_[i].as<float>() : memory_[0].as<float>() + i;
  };
  view_ = {{column(0), column(1), column(2)},
           {column(3), column(4), column(5)},
           boxes.size(),
           dense ? sizeof(float) : record};
}

TestBox BoxMaker::in_cube(double side, double size) {
  TestBox box;
  for (int i = 0; i < 3; ++i) {
    box.lower[i] = uniform(0, side);
    box.upper[i] = box.lower[i] + uniform(0, size);
  }
  return box;
}

TestBox BoxMaker::spoilt(const TestBox& box) {
  TestBox bad = box;
  const uint64_t axis = random_.below(3);
  switch (random_.below(4)) {
    case 0:
      bad.lower[axis] = kNan;
      break;
    case 1:
      bad.upper[axis] = kNan;
      break;
    case 2:
      bad = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
      break;
    default:
      bad.lower[axis] = std::nextafter(bad.upper[axis], kInfinity);
  }
  return bad;
}

double side_for(size_t count) { return std::cbrt(static_cast<double>(count) + 1); }

const char* name(BoxFamily family) {
  constexpr const char* kNames[kBoxFamilies] = {
      "random",    "clustered", "lattice",     "equal keys", "one point", "flat",
      "plane",     "giant",     "far cluster", "huge",       "infinite",  "spoilt",
      "subnormal", "decades",   "line",        "outlier",    "any bits"};
  return kNames[static_cast<int>(family)];
}

TestBox make_box(BoxFamily family, BoxMaker& maker, size_t i, size_t count) {
  Random& random = maker.random();
  const double side = side_for(count);
  TestBox box = maker.in_cube(side);
  const double size = family == BoxFamily::decades ? random.log_uniform(1e-5, 10) : 1;
  const bool is_far = family == BoxFamily::outlier && random.chance(0.02);
  for (int axis = 0; axis < 3; ++axis) {
    float& lower = box.lower[axis];
    float& upper = box.upper[axis];
    switch (family) {
      case BoxFamily::random:
        break;
      case BoxFamily::clustered:
        lower += static_cast<float>(i % 2) * 40;
        upper += static_cast<float>(i % 2) * 40;
        break;
      case BoxFamily::lattice:
        lower = static_cast<float>(random.below(static_cast<uint64_t>(side) + 2));
        upper = lower + 1;
        if (random.chance(0.1)) lower = lower == 0 ? -0.0f : lower;
        break;
      case BoxFamily::equal_keys:
        lower = axis == 1 ? static_cast<float>(random.below(3)) : 2;
        upper = lower + maker.uniform(0, 0.7);
        break;
      case BoxFamily::one_point:
        lower = upper = random.chance(0.5) ? 0.0f : -0.0f;
        break;
      case BoxFamily::flat:
        if (random.chance(0.5)) lower = upper = std::floor(lower);
        break;
      case BoxFamily::plane:
        if (axis == 2) lower = upper = 7;
        break;
      case BoxFamily::giant:
        if (i == count / 2) {
          lower = -1000;
          upper = 1000;
        }
        break;
      case BoxFamily::far_cluster:
        if (i % 2 == 0) {
          lower = 1e9f + 64 * std::floor(lower);
          upper = lower + 64;
        }
        break;
      case BoxFamily::huge:
        lower = maker.uniform(-1, 1) * (random.chance(0.1) ? kLargest : 1e38f);
        upper = std::fmin(kLargest, lower + maker.uniform(0, 1e38));
        break;
      case BoxFamily::infinite:
        if (random.chance(0.05)) lower = -kInfinity;
        if (random.chance(0.05)) upper = kInfinity;
        if (random.chance(0.02)) lower = upper = random.chance(0.5) ? kInfinity : -kInfinity;
        break;
      case BoxFamily::spoilt:
        break;
      case BoxFamily::subnormal:
        lower = static_cast<float>(random.below(99)) * 0x1p-149f;
        upper = lower + static_cast<float>(random.below(30)) * 0x1p-149f;
        break;
      case BoxFamily::decades:
        upper = lower + maker.uniform(0, size);
        break;
      case BoxFamily::line:
        lower =
            axis == 1 ? maker.uniform(0, 0.7 * static_cast<double>(count)) : maker.uniform(0, 1);
        upper = lower + 1;
        break;
      case BoxFamily::outlier:
        if (is_far) lower += maker.uniform(-1e6, 1e6);
        upper = lower + 1;
        break;
      case BoxFamily::any_bits:
        lower = random.any_float();
        upper = random.any_float();
        if (random.chance(0.8) && lower > upper) std::swap(lower, upper);
    }
  }
  if (family == BoxFamily::spoilt && random.chance(0.4)) return maker.spoilt(box);
  return box;
}

Boxes make_boxes(BoxFamily family, size_t count, uint64_t seed) {
  BoxMaker maker(seed);
  Boxes boxes(count);
  for (size_t i = 0; i < count; ++i) boxes[i] = make_box(family, maker, i, count);
  return boxes;
}

Filters::Filters(size_t count, uint64_t seed) {
  Random random(seed);
  for (size_t i = 0; i < count; ++i) {
    layer.push_back(1u << random.below(3));
    mask.push_back(static_cast<uint32_t>(random.below(8)));
    owner.push_back(static_cast<uint32_t>(random.below(6)));
    motion.push_back(static_cast<Motion>(random.below(3)));
  }
  Random others(seed + 1);
  for (size_t i = 0; i < count; ++i) {
    group.push_back(static_cast<int32_t>(others.below(7)) - 3);
    space.push_back(others.chance(0.2) ? 1 : 0);
  }
}

void Filters::exclude_some(const std::vector<Pair>& pairs, size_t count, uint64_t seed) {
  Random random(seed);
  excluded.clear();
  for (const Pair pair : pairs) {
    if (random.chance(0.3)) excluded.push_back(pair);
    const auto a = static_cast<uint32_t>(random.below(count));
    const auto b = static_cast<uint32_t>(random.below(count));
    if (a != b && random.chance(0.3)) excluded.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(excluded.begin(), excluded.end());
  excluded.erase(std::unique(excluded.begin(), excluded.end()), excluded.end());
}

void Filters::drops_some(std::span<const Pair> pairs, std::span<uint8_t> keep) {
  for (size_t i = 0; i < pairs.size(); ++i) {
    const uint64_t mixed = pair_key(pairs[i]) * 0x9e3779b97f4a7c15u;
    if (mixed >> 62 == 0) keep[i] = 0;
  }
}

PairFilter Filters::view(unsigned parts) const {
  PairFilter filter;
  if (parts & 1) filter.layer = layer.data();
  if (parts & 1) filter.mask = mask.data();
  if (parts & 2) filter.owner = owner.data();
  if (parts & 4) filter.motion = motion.data();
  if (parts & 8) filter.group = group.data();
  if (parts & 16) filter.space = space.data();
  if (parts & 32) filter.rule = FilterRule::either;
  if (parts & 64) filter.excluded = excluded;
  if (parts & 128) filter.predicate = &predicate;
  return filter;
}

bool may_meet(const PairFilter& f, uint32_t a, uint32_t b) {
  const int agree = f.layer ? ((f.layer[a] & f.mask[b]) != 0) + ((f.layer[b] & f.mask[a]) != 0) : 2;
  const bool layers = agree >= (f.rule == FilterRule::both ? 2 : 1);
  const bool owners = !f.owner || f.owner[a] != f.owner[b] || f.owner[a] == 0;
  const bool motion = !f.motion || f.motion[a] != Motion::fixed || f.motion[b] != Motion::fixed;
  const bool spaces = !f.space || f.space[a] == f.space[b];
  const int32_t group = f.group && f.group[a] == f.group[b] ? f.group[a] : 0;
  if (!owners || !motion || !spaces || group < 0 || (!layers && group == 0)) return false;
  const Pair pair = {a, b};
  if (std::find(f.excluded.begin(), f.excluded.end(), pair) != f.excluded.end()) return false;
  uint8_t keep = 1;
  if (f.predicate) (*f.predicate)({&pair, 1}, {&keep, 1});
  return keep != 0;
}

std::vector<Pair> plain_pairs(const Boxes& boxes, const PairFilter& filter) {
  std::vector<Pair> pairs;
  for (uint32_t a = 0; a < boxes.size(); ++a) {
    for (uint32_t b = a + 1; b < boxes.size(); ++b) {
      if (overlap(boxes[a], boxes[b]) && test::may_meet(filter, a, b)) pairs.push_back({a, b});
    }
  }
  return pairs;
}

std::vector<Pair> found_pairs(PairFinder& finder, const Boxes& boxes, BroadphaseMethod method,
                              const PairFilter& filter, Parallelism parallelism, size_t record) {
  const LaidOutBoxes memory(boxes, record);
  std::vector<Pair> pairs = {{7, 7}};  // contents of an earlier call
  finder.find(memory.view(), filter, pairs, method, parallelism);
  return pairs;
}

std::vector<Pair> found_pairs(const Boxes& boxes, BroadphaseMethod method, const PairFilter& filter,
                              Parallelism parallelism, size_t record) {
  PairFinder finder;
  return found_pairs(finder, boxes, method, filter, parallelism, record);
}

std::string difference(const std::vector<Pair>& got, const std::vector<Pair>& expected,
                       const Boxes& boxes) {
  std::string text =
      std::to_string(got.size()) + " pairs instead of " + std::to_string(expected.size());
  for (size_t i = 0; i < std::max(got.size(), expected.size()); ++i) {
    if (i < got.size() && i < expected.size() && got[i] == expected[i]) continue;
    const bool missing = i >= got.size() || (i < expected.size() && expected[i] < got[i]);
    const Pair pair = missing ? expected[i] : got[i];
    text += std::string(missing ? "; missing " : "; too many: ");
    for (const uint32_t body : {pair.a, pair.b}) {
      text += "\n  " + std::to_string(body);
      if (body >= boxes.size()) continue;
      text += ": " + hex3(boxes[body].lower) + " .. " + hex3(boxes[body].upper);
    }
    break;
  }
  return text;
}

}  // namespace carom::test
