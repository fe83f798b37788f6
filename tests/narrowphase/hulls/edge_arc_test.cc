// Edges beside cylinders: bounds hold on the whole arc, and searches find no less than samples do.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "narrowphase/hulls/solid_cylinder_scalar.h"
#include "oracle/hull_faces.h"
#include "oracle/random.h"

namespace carom::test {
namespace {

using oracle::Random;
using scalar::ArcPlace;
using scalar::EdgeArc;

constexpr float kRounding = 1e-6f;

// Directions of the whole arc, ends included.
std::vector<ArcPlace> samples_of(const EdgeArc& arc) {
  constexpr int kSamples = 200;
  const double angle = std::atan2(arc.end.v, arc.end.u);
  std::vector<ArcPlace> samples;
  for (int i = 0; i <= kSamples; ++i) {
    const double at = angle * i / kSamples;
    samples.push_back({static_cast<float>(std::cos(at)), static_cast<float>(std::sin(at))});
  }
  return samples;
}

float best_of(const EdgeArc& arc, const std::vector<ArcPlace>& samples) {
  float best = -scalar::kLargest;
  for (const ArcPlace& n : samples) best = std::max(best, arc.gap(n));
  return best;
}

scalar::PlacedCylinder random_cylinder(Random& random, double distance) {
  const auto length = [&] { return static_cast<float>(std::exp(random.uniform(-3, 0))); };
  return {(random.direction() * distance).cast<float>(), random.direction().cast<float>(), length(),
          length()};
}

Hull random_hull(Random& random) {
  std::vector<Eigen::Vector3f> points(16);
  for (Eigen::Vector3f& p : points) p = random.direction().cast<float>();
  return oracle::hull_of(points);
}

// Calls use(arc, bound, best sample, number) for the edges of random hulls beside cylinders that
// are this far away.
template <class Use>
void for_random_arcs(uint64_t seed, int count, double nearest, double furthest, const Use& use) {
  Random random(seed);
  for (int k = 0; k < count; ++k) {
    const Hull hull = random_hull(random);
    const SolidHull solid_of_hull(scalar::shape_as<float>(hull));
    const Solid& solid = solid_of_hull.view();
    const double distance = random.uniform(nearest, furthest);
    const scalar::PlacedCylinder cylinder = random_cylinder(random, distance);
    const scalar::FaceHeights faces(solid, cylinder);
    for (uint32_t e = 0; e < solid.edge_count; ++e) {
      const EdgeArc arc = scalar::arc_of_edge(solid, e, cylinder);
      const scalar::EdgeBound bound = scalar::bound_edge(solid, e, faces, cylinder);
      use(arc, bound, best_of(arc, samples_of(arc)), e);
    }
  }
}

TEST(EdgeArcs, BoundsHoldOnTheWholeArc) {
  size_t tight = 0, edges = 0, unknown = 0;
  for_random_arcs(1, 200, 0, 3,
                  [&](const EdgeArc& arc, const scalar::EdgeBound& bound, float best, uint32_t) {
                    EXPECT_GE(bound.most, best);
                    EXPECT_LE(bound.at_middle, best + kRounding);
                    const scalar::ArcBound by_arc(arc, scalar::places_on(arc)[0]);
                    EXPECT_GE(by_arc.most, best - kRounding);
                    EXPECT_LE(by_arc.at_middle, best + kRounding);
                    ++edges;
                    unknown += bound.most == scalar::kLargest;
                    tight += bound.most < best + 0.1f;
                  });
  EXPECT_GT(tight, edges / 2);
  EXPECT_GT(unknown, 0u);
  EXPECT_LT(unknown, edges / 10);
}

// Where a line is apart from the cylinder, the gap has one maximum on the side of each cap.
TEST(EdgeArcs, SearchesFindWhatSamplesDo) {
  size_t searched = 0;
  for_random_arcs(2, 300, 1, 4,
                  [&](const EdgeArc& arc, const scalar::EdgeBound& bound, float best, uint32_t e) {
                    const float ends = std::max(arc.gap({1, 0}), arc.gap(arc.end));
                    if (!(best > 0 && best > ends + 1e-4f)) return;
                    scalar::SolidWay found;
                    for (const float sign : {1.0f, -1.0f}) scalar::search_edge(arc, sign, e, found);
                    if (!found.has_ended) return;
                    ++searched;
                    EXPECT_GE(found.gap, best - kRounding);
                    EXPECT_EQ(found.gap, arc.gap({found.n.x(), found.n.y()}));
                    EXPECT_LE(found.gap, bound.most);
                  });
  EXPECT_GT(searched, 500u);
}

}  // namespace
}  // namespace carom::test
