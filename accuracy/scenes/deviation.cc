#include "accuracy/scenes/deviation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "carom/reference/reference.h"

namespace carom::accuracy {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Computed by the reference, which has the bits of the standard tier, because worlds do not keep
// the separations of separate pairs.
double standard_separation(const World& world, Pair pair) {
  const BodyId a = world.id_of(pair.a);
  const BodyId b = world.id_of(pair.b);
  return reference::collide(world.shape(a), {world.position(a), world.orientation(a)},
                            world.shape(b), {world.position(b), world.orientation(b)},
                            world.settings().positions)
      .separation;
}

double distance(double separation) {
  return std::isnan(separation) ? kInfinity : std::abs(separation);
}

// Pairs that are in `now` but not in `before`.
std::vector<Pair> new_pairs(const std::vector<Pair>& before, const std::vector<Pair>& now) {
  std::vector<Pair> pairs;
  std::set_difference(now.begin(), now.end(), before.begin(), before.end(),
                      std::back_inserter(pairs));
  return pairs;
}

bool contains(const std::vector<Pair>& pairs, Pair pair) {
  return std::binary_search(pairs.begin(), pairs.end(), pair);
}

// The least value that at least 99 % do not exceed.
double p99(std::vector<float>& values) {
  if (values.empty()) return 0;
  const size_t rank = (values.size() * 99 + 99) / 100 - 1;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank),
                   values.end());
  return values[rank];
}

}  // namespace

FrameResults results_of(const World& world) {
  FrameResults results;
  const std::span<const Pair> pairs = world.pairs();
  const std::span<const uint8_t> overlaps = world.overlaps();
  const std::span<const Contact> contacts = world.contacts();
  results.candidates = pairs.size();
  size_t next = 0;  // contacts are the overlaps without sensors, in the same order
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (overlaps[i] == kUndecided) results.undecided.push_back(pairs[i]);
    if (overlaps[i] != 1) continue;
    const bool has_contact =
        next < contacts.size() && Pair{contacts[next].a, contacts[next].b} == pairs[i];
    results.overlaps.push_back(pairs[i]);
    results.separation.push_back(has_contact ? contacts[next].separation
                                             : std::numeric_limits<float>::quiet_NaN());
    next += has_contact;
  }
  return results;
}

double Deviation::worst() const {
  return std::max({lost_worst, gained_worst, contact_error_worst});
}

void DeviationMeter::add(size_t frame, const World& world) {
  FrameResults other = results_of(world);
  deviation_.pairs += standard_[frame].candidates;
  deviation_.undecided += other.undecided.size();
  compare_overlaps(standard_[frame], other, world);
  compare_events(frame, other);
  other_before_ = std::move(other.overlaps);
}

void DeviationMeter::compare_overlaps(const FrameResults& standard, const FrameResults& other,
                                      const World& world) {
  size_t i = 0;
  size_t j = 0;
  while (i < standard.overlaps.size() || j < other.overlaps.size()) {
    const bool only_standard =
        j == other.overlaps.size() ||
        (i < standard.overlaps.size() && standard.overlaps[i] < other.overlaps[j]);
    const bool only_other = !only_standard && (i == standard.overlaps.size() ||
                                               other.overlaps[j] < standard.overlaps[i]);
    if (only_standard) {
      const Pair pair = standard.overlaps[i];
      if (!contains(other.undecided, pair)) note_lost(pair, standard.separation[i], world);
    } else if (only_other) {
      const double gap = distance(standard_separation(world, other.overlaps[j]));
      ++deviation_.gained;
      deviation_.gained_worst = std::max(deviation_.gained_worst, gap);
    } else {
      note_common(standard.separation[i], other.separation[j]);
    }
    i += !only_other;
    j += !only_standard;
  }
}

void DeviationMeter::note_lost(Pair pair, double separation, const World& world) {
  if (std::isnan(separation)) separation = standard_separation(world, pair);
  ++deviation_.lost;
  deviation_.lost_worst = std::max(deviation_.lost_worst, distance(separation));
}

// Overlaps with sensors have no contact in either run: NaN.
void DeviationMeter::note_common(float separation, float other) {
  if (std::isnan(separation) && std::isnan(other)) return;
  const double error = separation == other ? 0 : distance(double{separation} - double{other});
  deviation_.contact_error_worst = std::max(deviation_.contact_error_worst, error);
  contact_errors_.push_back(static_cast<float>(error));
}

void DeviationMeter::compare_events(size_t frame, const FrameResults& other) {
  static const std::vector<Pair> none;
  const std::vector<Pair>& now = standard_[frame].overlaps;
  const std::vector<Pair>& before = frame == 0 ? none : standard_[frame - 1].overlaps;
  const auto missing = [](const std::vector<Pair>& events, const std::vector<Pair>& others) {
    return new_pairs(others, events).size();
  };
  deviation_.events_moved +=
      missing(new_pairs(before, now), new_pairs(other_before_, other.overlaps));
  deviation_.events_moved +=
      missing(new_pairs(now, before), new_pairs(other.overlaps, other_before_));
}

Deviation DeviationMeter::finish() {
  deviation_.contact_error_p99 = p99(contact_errors_);
  return deviation_;
}

}  // namespace carom::accuracy
