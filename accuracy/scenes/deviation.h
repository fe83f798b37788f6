// How far the results of one run of a scene are from those of another one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/world/world.h"

namespace carom::accuracy {

// What comparing needs of one frame; lists are sorted.
struct FrameResults {
  size_t candidates = 0;
  std::vector<Pair> overlaps;
  std::vector<float> separation;  // of each overlap; not a number where one of the two is a sensor
  std::vector<Pair> undecided;
};

// Of the last step of a world with contacts.
FrameResults results_of(const World& world);

// Sums over all frames. Lengths are metres; what is infinite could not be compared.
struct Deviation {
  uint64_t pairs = 0;              // candidates of the run that is the measure
  uint64_t lost = 0;               // overlaps that are missing
  uint64_t gained = 0;             // overlaps that are none
  uint64_t undecided = 0;          // neither lost nor gained
  uint64_t events_moved = 0;       // begins and ends that do not happen in the same frame
  double lost_worst = 0;           // how deep the deepest lost overlap is
  double gained_worst = 0;         // how far apart the farthest gained overlap is
  double contact_error_worst = 0;  // of the separations of overlaps that both have
  double contact_error_p99 = 0;

  // The greatest of all lengths.
  double worst() const;
};

// Compares a run with `standard`, one entry a frame, which has to live as long.
class DeviationMeter {
 public:
  explicit DeviationMeter(std::span<const FrameResults> standard) : standard_(standard) {}

  // After each step of the other run, which has the same bodies in the same places.
  void add(size_t frame, const World& world);
  Deviation finish();

 private:
  void compare_overlaps(const FrameResults& standard, const FrameResults& other,
                        const World& world);
  void note_lost(Pair pair, double separation, const World& world);
  void note_common(float separation, float other);
  void compare_events(size_t frame, const FrameResults& other);

  std::span<const FrameResults> standard_;
  Deviation deviation_;
  std::vector<float> contact_errors_;
  std::vector<Pair> other_before_;  // overlaps of the other run in the frame before
};

}  // namespace carom::accuracy
