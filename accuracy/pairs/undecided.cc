#include "accuracy/pairs/undecided.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "accuracy/pairs/samples.h"
#include "accuracy/tiers/contenders.h"
#include "accuracy/tiers/timing.h"

namespace carom::accuracy {
namespace {

using Json = nlohmann::ordered_json;

struct Scene {
  const char* name;
  std::vector<ConvexPair> pairs;
};

std::vector<ConvexPair> of_kind(ShapeKind kind, size_t count, uint64_t seed) {
  return random_pairs({kind, kind}, count, seed);
}

// Random pairs of spheres, capsules, aabbs and boxes, in random order.
std::vector<ConvexPair> mixed_pairs(size_t count, uint64_t seed) {
  constexpr ShapeKind kKinds[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::aabb,
                                  ShapeKind::box};
  std::vector<ConvexPair> all;
  for (const ShapeKind a : kKinds) {
    for (const ShapeKind b : kKinds) {
      const auto some = random_pairs({std::min(a, b), std::max(a, b)}, count / 16, seed);
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  Random random(seed);
  for (size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random.below(i)]);
  return all;
}

// Neighbours in a stack of cubes with quarter turns or none: faces, edges and corners that touch.
std::vector<ConvexPair> stacked_boxes(size_t count, uint64_t seed) {
  Random random(seed);
  oracle::ConvexRandom shapes({.lattice = true}, random);
  std::vector<ConvexPair> pairs;
  while (pairs.size() < count) {
    ConvexPair pair;
    pair.shape_a = pair.shape_b = Box{Eigen::Vector3f::Constant(0.5f)};
    for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
      if (random.chance(0.5)) pose->orientation = shapes.quarter_turns();
    }
    for (double& x : pair.pose_a.position) x = shapes.integer(0, 100);
    pair.pose_b.position = pair.pose_a.position;
    for (double& x : pair.pose_b.position) x += shapes.integer(-1, 1);
    if (pair.pose_a.position != pair.pose_b.position) pairs.push_back(pair);
  }
  return pairs;
}

std::vector<ConvexPair> near_parallel_boxes(size_t count, uint64_t seed) {
  constexpr double kAngles[] = {0, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
  std::vector<ConvexPair> all;
  for (const double angle : kAngles) {
    const auto some = near_parallel_pairs({ShapeKind::box, ShapeKind::box}, angle,
                                          count / std::size(kAngles), seed);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

Json row_of(const Scene& scene, int rounds) {
  const PairSet pairs(scene.pairs, PositionType::float32);
  LibrarySetting settings[] = {standard_setting(), certified_setting(), exact_setting(),
                               single_precision_setting()};
  Answers answers(pairs.size());
  std::vector<std::function<void()>> passes;
  for (LibrarySetting& setting : settings) {
    passes.emplace_back([&] { setting.run(pairs, Detail::contact, answers); });
  }
  const std::vector<double> times = median_seconds(passes, rounds);
  settings[1].run(pairs, Detail::contact, answers);
  const auto undecided = std::count(answers.overlap, answers.overlap + pairs.size(), kUndecided);
  const auto count = static_cast<double>(pairs.size());
  return {{"scene", scene.name},
          {"pairs", pairs.size()},
          {"undecided", static_cast<double>(undecided) / count},
          {"ns_standard", times[0] * 1e9 / count},
          {"ns_certified", times[1] * 1e9 / count},
          {"ns_exact", times[2] * 1e9 / count},
          {"ns_single_precision", times[3] * 1e9 / count}};
}

}  // namespace

void measure_undecided(size_t pairs, int rounds, uint64_t seed, Json& rows) {
  const std::function<Scene()> scenes[] = {
      [&]() -> Scene {
        return {"random spheres", of_kind(ShapeKind::sphere, pairs, seed)};
      },
      [&]() -> Scene {
        return {"random capsules", of_kind(ShapeKind::capsule, pairs, seed)};
      },
      [&]() -> Scene {
        return {"random boxes", of_kind(ShapeKind::box, pairs, seed)};
      },
      [&]() -> Scene {
        return {"random mixed", mixed_pairs(pairs, seed)};
      },
      [&]() -> Scene {
        return {"boxes stacked on a lattice", stacked_boxes(pairs, seed)};
      },
      [&]() -> Scene {
        return {"near-parallel boxes", near_parallel_boxes(pairs / 10, seed)};
      },
  };
  for (const auto& scene : scenes) rows.push_back(row_of(scene(), rounds));
}

}  // namespace carom::accuracy
