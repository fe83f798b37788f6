// carom_soak [SCENE TOLERANCE [FRAMES]]: plays a scene within a tolerance beside the same without,
// and compares every decision and every contact of every frame; where there are meshes, the gaps
// between those that overlap. Ends with 1 if an error is greater than the tolerance allows.
// TOLERANCE: metres, or a share of the median bounding radius as 1e-3L.
// Without arguments: generated scenes of all kinds, 1,000 frames each, more than ten million pairs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "accuracy/pairs/body_size.h"
#include "accuracy/scenes/trials.h"
#include "cli/scenes/loaded_scene.h"

namespace carom::bench {
namespace {

constexpr size_t kMostBytes = size_t{1} << 31;  // of the frames of a scene
// The rounding of both runs, a share of the size of the scene: docs/accuracy.md.
constexpr double kRounding = 0x1p-17;

struct Order {
  std::string scene;
  double tolerance = 0;
  bool is_share = false;  // of the median radius
  size_t frames = 1000;
};

std::vector<Order> all_orders() {
  std::vector<Order> orders;
  for (const std::string kind :
       {"brownian:shape=sphere", "brownian:shape=capsule", "brownian:shape=box",
        "brownian:shape=hull", "brownian:shape=mesh", "brownian:shape=compound", "varied:"}) {
    const bool turns = !kind.ends_with("sphere") && !kind.ends_with(":");
    for (const std::string speed : {"0.005", "0.05"}) {
      std::string scene = kind + (kind.ends_with(":") ? "" : ",") +
                          "n=400,frames=1000,seed=7,density=0.3,speed=" + speed;
      if (turns) scene += ",spin=" + speed;
      for (const double share : {1e-4, 1e-3, 1e-2, 1e-1}) {
        orders.push_back({.scene = scene, .tolerance = share, .is_share = true});
      }
    }
  }
  return orders;
}

bool read_order(int argc, char** argv, Order& order) {
  if (argc != 3 && argc != 4) return false;
  order.scene = argv[1];
  char* end = nullptr;
  order.tolerance = std::strtod(argv[2], &end);
  order.is_share = std::strcmp(end, "L") == 0;
  if (argc == 4) order.frames = std::strtoull(argv[3], nullptr, 10);
  return order.tolerance > 0 && (order.is_share || *end == 0) && order.frames > 0;
}

struct Sizes {
  double median_radius = 0, greatest = 0;
};

Sizes sizes_of(const cli::LoadedScene& scene) {
  World world({.positions = scene.positions()});
  scene.start(world);
  Sizes sizes;
  std::vector<double> radii;
  for (uint32_t i = 0; i < world.size(); ++i) {
    const double radius = accuracy::bounding_radius(world.shape(world.id_of(i)));
    if (std::isfinite(radius)) radii.push_back(radius);
  }
  for (const double radius : radii) sizes.greatest = std::max(sizes.greatest, radius);
  sizes.median_radius = accuracy::median(std::move(radii));
  return sizes;
}

// Of surfaces that cross, other triangles may be reported when a body moves by next to nothing: the
// inner edges of a mesh hide contacts by the side of the other body. Of gaps that is not so.
bool has_meshes(const cli::LoadedScene& scene) {
  World world({.positions = scene.positions()});
  scene.start(world);
  for (uint32_t i = 0; i < world.size(); ++i) {
    if (std::holds_alternative<Mesh>(world.shape(world.id_of(i)))) return true;
  }
  return false;
}

// How many pairs were compared, and whether the promise was kept.
struct Outcome {
  uint64_t pairs = 0;
  bool is_kept = true;
};

Result<Outcome> soak(const Order& order) {
  const auto opened = cli::LoadedScene::open(order.scene);
  if (!opened) return opened.error();
  cli::LoadedScene& scene = **opened;
  if (const auto loaded = scene.load(order.frames, kMostBytes); !loaded) return loaded.error();
  const Result<accuracy::StandardRun> standard = accuracy::run_standard(scene);
  if (!standard) return standard.error();
  const Sizes sizes = sizes_of(scene);
  const double tolerance = order.tolerance * (order.is_share ? sizes.median_radius : 1);
  const double error = error_within(tolerance);
  if (const auto ladders = scene.add_ladders({&error, 1}); !ladders) return ladders.error();

  accuracy::Trial trial{.name = "tolerance", .settings = {}};
  trial.settings.accuracy.tolerance = static_cast<float>(tolerance);
  const auto results = accuracy::run_trials(scene, *standard, {&trial, 1}, {.rounds = 0});
  if (!results) return results.error();
  const accuracy::TrialResult& result = *results->front();
  const bool gaps_alone = has_meshes(scene);
  const double worst = gaps_alone ? result.deviation.gained_worst : result.deviation.worst();
  const bool is_kept = worst <= tolerance + kRounding * sizes.greatest;
  std::printf("%-72s %9.3g %10llu %9.3f %9.3g %8.2f%s%s\n", order.scene.c_str(), tolerance,
              static_cast<unsigned long long>(result.deviation.pairs),
              static_cast<double>(result.tested) / static_cast<double>(standard->tested), worst,
              tolerance / worst, gaps_alone ? "  gaps alone" : "", is_kept ? "" : "  TOO MUCH");
  std::fflush(stdout);
  return Outcome{result.deviation.pairs, is_kept};
}

int soak_all(const std::vector<Order>& orders) {
  std::printf("%-72s %9s %10s %9s %9s %8s\n", "scene", "tolerance", "pairs", "tested", "worst",
              "by worst");
  Outcome all;
  for (const Order& order : orders) {
    const Result<Outcome> outcome = soak(order);
    if (!outcome) {
      std::fprintf(stderr, "carom_soak: %s\n", outcome.error().message.c_str());
      return 1;
    }
    all.pairs += outcome->pairs;
    all.is_kept = all.is_kept && outcome->is_kept;
  }
  std::printf("%llu pairs, %s\n", static_cast<unsigned long long>(all.pairs),
              all.is_kept ? "all within the tolerance" : "some errors are too great");
  return all.is_kept ? 0 : 1;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  carom::bench::Order order;
  if (argc == 1) return carom::bench::soak_all(carom::bench::all_orders());
  if (carom::bench::read_order(argc, argv, order)) return carom::bench::soak_all({order});
  std::fprintf(stderr, "usage: carom_soak [SCENE TOLERANCE[L] [FRAMES]]\n");
  return 2;
}
