// Measures the clearance of a machine's parts, step after step. The parts are convex hulls and the
// pairs stay the same, so each step starts from the features of the last one.
#include <carom/carom.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

constexpr int kSteps = 90;

using Row = std::array<float, 4>;

carom::Hull wedge() {
  const std::vector<Eigen::Vector3f> points = {{-1, -0.3f, 0}, {1, -0.3f, 0}, {1, 0.3f, 0},
                                               {-1, 0.3f, 0},  {-1, 0, 0.5f}, {1, 0, 0.2f}};
  const std::vector<std::vector<uint32_t>> faces = {
      {3, 2, 1, 0}, {0, 1, 5, 4}, {2, 3, 4, 5}, {1, 2, 5}, {3, 0, 4}};
  return {*carom::make_hull(points, faces)};
}

// One record of each kind for every body, as Carom reads them.
struct Bodies {
  std::vector<Row> positions;     // x, y, z and an unused number
  std::vector<Row> orientations;  // x, y, z, w
  std::vector<Row> shapes;        // the hull that all of them share

  Bodies(size_t count, const carom::Hull& hull)
      : positions(count),
        orientations(count, Row{0, 0, 0, 1}),
        shapes(count, carom::shape_rows(hull)[0]) {}

  carom::Collidables view() const {
    carom::Collidables view;
    view.count = positions.size();
    view.position = {.data = positions[0].data(), .stride = sizeof(Row)};
    view.uniform_kind = carom::ShapeKind::hull;
    view.orientation = {.data = orientations[0].data(), .stride = sizeof(Row)};
    view.rows = {.data = shapes[0].data()};
    return view;
  }
};

void turn_about_z(Row& orientation, float angle) {
  orientation = {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
}

}  // namespace

int main() {
  // A row of wedges, and above each another one, which turns.
  constexpr uint32_t kCount = 64;
  const carom::Hull hull = wedge();
  Bodies still(kCount, hull), turning(kCount, hull);
  std::vector<carom::Pair> pairs;
  for (uint32_t i = 0; i < kCount; ++i) {
    still.positions[i] = {3.0f * static_cast<float>(i), 0, 0, 0};
    turning.positions[i] = {3.0f * static_cast<float>(i), 0.2f, 0.2f + 0.01f * float(i), 0};
    pairs.push_back({i, i});
  }

  std::vector<uint8_t> overlap(kCount), overlap_again(kCount);
  std::vector<float> clearance(kCount), clearance_again(kCount);
  std::vector<uint64_t> features(kCount, 0);  // kept from step to step
  const auto measure = [&](const carom::ResultColumns& out) {
    return carom::collide(still.view(), turning.view(), pairs, carom::Detail::contact, out,
                          {.measured = carom::Measured::separate});
  };
  bool all_agree = true;
  for (int step = 0; step < kSteps; ++step) {
    for (uint32_t i = 0; i < kCount; ++i) {
      turn_about_z(turning.orientations[i], 0.02f * static_cast<float>(step));
    }
    const auto known = measure(
        {.overlap = overlap.data(), .separation = clearance.data(), .features = features.data()});
    const auto anew =
        measure({.overlap = overlap_again.data(), .separation = clearance_again.data()});
    if (!known || !anew) return 1;
    for (uint32_t i = 0; i < kCount; ++i) {
      const bool is_near = overlap[i] || std::fabs(clearance[i] - clearance_again[i]) < 1e-5f;
      all_agree = all_agree && overlap[i] == overlap_again[i] && is_near;
    }
    if (step % 30 == 0) {
      std::printf("step %2d: %td of %u touch, pair %u is %.4f m apart\n", step,
                  std::count(overlap.begin(), overlap.end(), 1), kCount, kCount - 1,
                  clearance[kCount - 1]);
    }
  }
  std::printf("with features as without: %s\n", all_agree ? "yes" : "NO");
  return all_agree ? 0 : 1;
}
