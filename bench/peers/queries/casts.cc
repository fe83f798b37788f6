// carom_cast_peers [--smoke]: spheres, capsules, boxes and hulls of 16 corners, cast through static
// bodies and at one mesh of triangles; Carom beside Bullet and FCL, closest hits, on one thread.
// Prints tables in Markdown. Exit code 1 if a hit of Carom is wrong.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "bench/peers/queries/cast_peer.h"
#include "bench/peers/queries/cast_referee.h"
#include "bench/peers/queries/cast_scene.h"
#include "bench/peers/queries/fastest_pass.h"

namespace carom::bench {
namespace {

// Metres along the normal of a hit. Bullet stops a millimetre before a surface, and margins change
// surfaces by a quarter of one. FCL stops where 1e-4 of the path, here at most 2 mm, remain.
constexpr double kTolerance = 2.5e-3;
constexpr size_t kChecked = 100;  // hits that the referee looks at in any case

class CaromCasts {
 public:
  CaromCasts(const World& world, const CastWorld& scene, const CastList& list)
      : world_(world), arrays_(scene, list) {}

  // All casts in one call.
  void run(std::span<float> times) {
    world_.cast(arrays_.queries(), arrays_.sweep(), hits_);
    std::fill(times.begin(), times.end(), 2.0f);
    for (const CastHit& hit : hits_) times[hit.query] = hit.toi;
  }
  // A call for each cast.
  void run_singly(std::span<float> times) {
    std::vector<CastHit> hits;
    for (size_t i = 0; i < times.size(); ++i) {
      world_.cast(arrays_.query(i), arrays_.sweep(i), hits);
      times[i] = hits.empty() ? 2 : hits[0].toi;
    }
  }
  // run() leaves the hits of its last call here.
  const std::vector<CastHit>& hits() const { return hits_; }

 private:
  const World& world_;
  const CastArrays arrays_;
  std::vector<CastHit> hits_;
};

struct Agreement {
  size_t casts = 0;
  size_t early = 0, late = 0;  // casts in which the peer errs by more than the tolerance
  double worst_early = 0, worst_late = 0;  // metres
  size_t carom_wrong = 0;
};

Agreement compare(const CastList& list, const Referee& referee, const std::vector<CastHit>& hits,
                  const std::vector<float>& carom, const std::vector<float>& peer) {
  std::vector<double> towards(carom.size());  // metres by which a cast nears the surface
  for (const CastHit& hit : hits) {
    if (hit.query >= towards.size()) break;
    const auto& [x, y, z] = list.displacements[hit.query];
    towards[hit.query] = std::abs(hit.normal.dot(Eigen::Vector3f(x, y, z)));
  }
  Agreement result = {.casts = peer.size()};
  for (size_t i = 0; i < peer.size(); ++i) {
    const bool both = carom[i] <= 1 && peer[i] <= 1;
    if (!both && carom[i] > 1 && peer[i] > 1) continue;
    if (both && std::abs(carom[i] - peer[i]) * towards[i] <= kTolerance) continue;
    const auto [error, wrong] =
        referee.judge(list.queries[i], list.displacements[i], carom[i], peer[i]);
    if (wrong) {
      ++result.carom_wrong;
      std::fprintf(stderr, "cast %zu: Carom %.9g, peer %.9g\n", i, carom[i], peer[i]);
    }
    const bool is_early = peer[i] < carom[i];
    double& worst = is_early ? result.worst_early : result.worst_late;
    worst = std::max(worst, error);
    if (error > kTolerance) ++(is_early ? result.early : result.late);
  }
  return result;
}

// Hits of Carom at which the query touches nothing, among the first.
size_t wrong_hits(const CastList& list, const Referee& referee, const std::vector<CastHit>& hits) {
  size_t wrong = 0;
  for (size_t i = 0; i < std::min(hits.size(), kChecked); ++i) {
    const uint32_t query = hits[i].query;
    wrong += !referee.touches(list.queries[query], list.displacements[query], hits[i].toi);
  }
  return wrong;
}

void add_line(std::string& table, const char* scene, const char* shape, float length,
              const char* peer, const Agreement& agreement) {
  char line[200];
  std::snprintf(line, sizeof line, "| %s | %s | %g m | %s | %zu | %zu | %.2f | %zu | %.2f |\n",
                scene, shape, length, peer, agreement.casts, agreement.early,
                1e3 * agreement.worst_early, agreement.late, 1e3 * agreement.worst_late);
  table += line;
}

struct Extent {
  size_t casts, single_casts, fcl_casts;
  int passes;
};

// Returns how many hits of Carom are wrong.
size_t run_scene(const char* name, const CastWorld& scene, const Extent& extent,
                 std::string& agreements) {
  const World world = scene.make_world();
  const Referee referee(scene);
  const auto bullet = make_bullet_casts(scene.scene);
  const auto fcl = make_fcl_casts(scene.scene);
  size_t wrong = 0;
  constexpr const char* kShapes[] = {"sphere", "capsule", "box", "hull"};
  for (int shape = 0; shape < 4; ++shape) {
    for (const float length : {2.0f, 20.0f}) {
      const CastList list =
          draw_casts(scene, world, static_cast<CastShape>(shape), length, extent.casts);
      CaromCasts carom(world, scene, list);
      bullet->prepare(list);
      fcl->prepare(list);
      std::vector<float> ours(extent.casts), singly(extent.single_casts), of_bullet(extent.casts),
          of_fcl(extent.fcl_casts);
      const auto time = [&](size_t casts, const auto& run) {
        return fastest_pass(casts, extent.passes, run);
      };
      const double ns = time(extent.casts, [&] { carom.run(ours); });
      const double ns_singly = time(extent.single_casts, [&] { carom.run_singly(singly); });
      const double ns_bullet = time(extent.casts, [&] { bullet->run(of_bullet); });
      const double ns_fcl = fastest_pass(extent.fcl_casts, 1, [&] { fcl->run(of_fcl); });
      std::printf("| %s | %s | %g m | %.2f | %.0f | %.0f | %.0f | %.0f | %.1f | %.1f |\n", name,
                  kShapes[shape], length, double(carom.hits().size()) / double(extent.casts), ns,
                  ns_singly, ns_bullet, ns_fcl, ns_bullet / ns, ns_fcl / ns);
      std::fflush(stdout);
      const Agreement with_bullet = compare(list, referee, carom.hits(), ours, of_bullet);
      const Agreement with_fcl = compare(list, referee, carom.hits(), ours, of_fcl);
      add_line(agreements, name, kShapes[shape], length, "Bullet", with_bullet);
      add_line(agreements, name, kShapes[shape], length, "FCL", with_fcl);
      wrong += with_bullet.carom_wrong + with_fcl.carom_wrong;
      wrong += wrong_hits(list, referee, carom.hits());
      wrong += !std::equal(singly.begin(), singly.end(), ours.begin());
    }
  }
  return wrong;
}

int run(bool smoke) {
  const Extent among_bodies = smoke ? Extent{200, 50, 50, 1} : Extent{20'000, 2'000, 1'000, 5};
  const Extent at_mesh = smoke ? Extent{200, 50, 10, 1} : Extent{20'000, 2'000, 100, 5};
  const CastWorld yard = make_yard(smoke ? 2'000 : 20'000);
  const CastWorld terrain = make_terrain(smoke ? 50 : 400);
  std::printf(
      "%zu bodies; a mesh of %zu triangles; ns a cast; ratios: peer / Carom\n\n"
      "| scene | cast | length | share that hits | Carom | Carom, a call each | Bullet | FCL | "
      "Bullet / Carom | FCL / Carom |\n|---|---|---|---|---|---|---|---|---|---|\n",
      yard.scene.bodies.size(), terrain.scene.triangles.size());
  std::string agreements;
  const size_t wrong = run_scene("bodies", yard, among_bodies, agreements) +
                       run_scene("mesh", terrain, at_mesh, agreements);
  std::printf(
      "\nHits of the peers that are more than %.1f mm early, or late or missing; the worst, in "
      "mm\n\n"
      "| scene | cast | length | peer | casts | early | worst | late or missing | worst |\n"
      "|---|---|---|---|---|---|---|---|---|\n%s",
      1e3 * kTolerance, agreements.c_str());
  if (wrong > 0) std::fprintf(stderr, "carom_cast_peers: %zu hits of Carom are wrong\n", wrong);
  return wrong > 0 ? 1 : 0;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  return carom::bench::run(argc > 1 && std::string_view(argv[1]) == "--smoke");
}
