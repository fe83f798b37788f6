// Collision tests over a program's own arrays, without a world and without copies:
//   bounds -> pairs, pairs + shapes -> results.
#include <carom/carom.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

namespace {

// The program's own records: x, y, z and radius first, other data behind them.
struct Particle {
  float x, y, z, radius;
  float temperature;
  int32_t species;
};

// The program's own boxes: one column for each coordinate.
struct Boxes {
  std::vector<float> min_x, min_y, min_z, max_x, max_y, max_z;
};

// Six columns for bounds, which Carom writes and reads.
struct Bounds {
  std::vector<float> columns[6];

  explicit Bounds(size_t count) {
    for (std::vector<float>& column : columns) column.resize(count);
  }
  carom::BoundsColumns from(size_t first) {
    const auto at = [&](int i) { return columns[i].data() + first; };
    return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}};
  }
  carom::BoundsView view() const {
    const auto at = [&](int i) { return columns[i].data(); };
    return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, columns[0].size()};
  }
};

std::vector<Particle> make_particles(size_t count) {
  std::mt19937 random(1);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random()) * 0x1p-32f;
  };
  std::vector<Particle> particles(count);
  for (Particle& p : particles) {
    p = {uniform(0, 10), uniform(0, 10), uniform(0, 10), uniform(0.1f, 0.5f), 20, 0};
  }
  return particles;
}

// Shelves through the whole volume.
Boxes make_boxes() {
  Boxes boxes;
  for (const float height : {2.0f, 5.0f, 8.0f}) {
    boxes.min_x.push_back(1), boxes.min_y.push_back(1), boxes.min_z.push_back(height);
    boxes.max_x.push_back(9), boxes.max_y.push_back(9), boxes.max_z.push_back(height + 0.1f);
  }
  return boxes;
}

carom::Collidables view_of(const std::vector<Particle>& particles) {
  return carom::sphere_records(&particles[0].x, particles.size(), sizeof(Particle));
}

carom::Collidables view_of(const Boxes& boxes) {
  return carom::world_boxes({{boxes.min_x.data(), boxes.min_y.data(), boxes.min_z.data()},
                             {boxes.max_x.data(), boxes.max_y.data(), boxes.max_z.data()}},
                            boxes.min_x.size());
}

// If the buffer is too small, find_pairs() writes nothing and returns the room that it needs.
std::vector<carom::Pair> find_pairs(const Bounds& bounds, const carom::PairFilter& filter) {
  std::vector<carom::Pair> pairs(16);
  const size_t count = carom::find_pairs(bounds.view(), filter, pairs);
  const bool too_small = count > pairs.size();
  std::printf("  %zu pairs of bounds overlap%s\n", count, too_small ? "; asking again" : "");
  pairs.resize(count);
  if (too_small) carom::find_pairs(bounds.view(), filter, pairs);
  return pairs;
}

bool check(bool holds, const char* claim) {
  std::printf("  %-6s %s\n", holds ? "ok" : "FAILED", claim);
  return holds;
}

// The plain loops that Carom replaces. Doubles hold the sums of these floats exactly enough.
size_t count_overlaps_one_by_one(const std::vector<Particle>& particles) {
  size_t count = 0;
  for (size_t i = 0; i < particles.size(); ++i) {
    for (size_t j = i + 1; j < particles.size(); ++j) {
      const Particle &a = particles[i], &b = particles[j];
      const double x = double{b.x} - a.x, y = double{b.y} - a.y, z = double{b.z} - a.z;
      count += std::sqrt(x * x + y * y + z * z) <= double{a.radius} + b.radius;
    }
  }
  return count;
}

size_t count_overlaps_one_by_one(const std::vector<Particle>& particles, const Boxes& boxes) {
  size_t count = 0;
  for (size_t i = 0; i < boxes.min_x.size(); ++i) {
    for (const Particle& p : particles) {
      const double x = std::clamp(p.x, boxes.min_x[i], boxes.max_x[i]) - double{p.x};
      const double y = std::clamp(p.y, boxes.min_y[i], boxes.max_y[i]) - double{p.y};
      const double z = std::clamp(p.z, boxes.min_z[i], boxes.max_z[i]) - double{p.z};
      count += std::sqrt(x * x + y * y + z * z) <= p.radius;
    }
  }
  return count;
}

bool particles_against_each_other(const std::vector<Particle>& particles) {
  std::printf("particles against each other\n");
  Bounds bounds(particles.size());
  carom::compute_bounds(view_of(particles), bounds.from(0));
  const std::vector<carom::Pair> pairs = find_pairs(bounds, {});

  // Carom writes only the columns that are given.
  std::vector<uint8_t> overlap(pairs.size());
  std::vector<float> separation(pairs.size());
  const carom::Result<void> done =
      carom::collide(view_of(particles), view_of(particles), pairs, carom::Detail::contact,
                     {.overlap = overlap.data(), .separation = separation.data()});
  if (!done) return check(false, done.error().message.c_str());

  const auto overlaps = static_cast<size_t>(std::count(overlap.begin(), overlap.end(), 1));
  std::printf("  %zu of them overlap in truth, the deepest by %.3f m\n", overlaps,
              -*std::min_element(separation.begin(), separation.end()));
  return check(overlaps == count_overlaps_one_by_one(particles), "as many as one by one");
}

// Two sets: their bounds follow each other, and a filter passes only mixed pairs.
bool particles_against_boxes(const std::vector<Particle>& particles, const Boxes& boxes) {
  std::printf("particles against boxes\n");
  const size_t count = particles.size();
  const size_t total = count + boxes.min_x.size();
  Bounds bounds(total);
  carom::compute_bounds(view_of(particles), bounds.from(0));
  carom::compute_bounds(view_of(boxes), bounds.from(count));
  std::vector<uint32_t> layer(total, 1), mask(total, 2);
  std::fill(layer.begin() + count, layer.end(), 2u);
  std::fill(mask.begin() + count, mask.end(), 1u);
  std::vector<carom::Pair> pairs = find_pairs(bounds, {.layer = layer.data(), .mask = mask.data()});
  for (carom::Pair& pair : pairs) pair.b -= static_cast<uint32_t>(count);

  std::vector<uint8_t> overlap(pairs.size());
  const carom::Result<void> done =
      carom::collide(view_of(particles), view_of(boxes), pairs, carom::Detail::overlap,
                     {.overlap = overlap.data()});
  if (!done) return check(false, done.error().message.c_str());
  const auto overlaps = static_cast<size_t>(std::count(overlap.begin(), overlap.end(), 1));
  std::printf("  %zu times a particle touches a box\n", overlaps);
  return check(overlaps == count_overlaps_one_by_one(particles, boxes), "as many as one by one");
}

// Every point against every particle. Small sets need no bounds.
bool points_in_particles(const std::vector<Particle>& particles) {
  std::printf("points in particles\n");
  const Particle& first = particles[0];
  const float probes[][3] = {{first.x, first.y, first.z}, {-1, -1, -1}, {5, 5, 5}};
  std::vector<carom::Pair> pairs;
  for (uint32_t point = 0; point < 3; ++point) {
    for (uint32_t i = 0; i < particles.size(); ++i) pairs.push_back({point, i});
  }
  std::vector<uint8_t> overlap(pairs.size());
  const carom::Result<void> done =
      carom::collide(carom::points(probes[0], 3), view_of(particles), pairs, carom::Detail::overlap,
                     {.overlap = overlap.data()});
  if (!done) return check(false, done.error().message.c_str());

  const auto holders = [&](size_t point) {
    const auto begin = overlap.begin() + static_cast<ptrdiff_t>(point * particles.size());
    return std::count(begin, begin + static_cast<ptrdiff_t>(particles.size()), 1);
  };
  std::printf("  held by %td, %td and %td particles\n", holders(0), holders(1), holders(2));
  bool all = check(overlap[0] == 1, "a centre lies in its own particle");
  all &= check(holders(1) == 0, "a point outside lies in none");
  return all;
}

}  // namespace

int main() {
  const std::vector<Particle> particles = make_particles(2000);
  const Boxes boxes = make_boxes();
  bool all = particles_against_each_other(particles);
  all &= particles_against_boxes(particles, boxes);
  all &= points_in_particles(particles);
  return all ? 0 : 1;
}
