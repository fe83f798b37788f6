// Measures how far the results of one run of a scene deviate from another run's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/world/world.h"

namespace carom::accuracy {

// The results of one frame that a comparison needs; lists are sorted.
struct FrameResults {
  size_t candidates = 0;
  std::vector<Pair> overlaps;
  std::vector<float> separation;  // of each overlap; NaN if a body is a sensor
  std::vector<Pair> undecided;
};

// Results of the last step of a world with contacts.
FrameResults results_of(const World& world);

// Sums over all frames. Lengths are metres; infinite if they could not be compared.
struct Deviation {
  uint64_t pairs = 0;              // candidates of the standard run
  uint64_t lost = 0;               // overlaps of the standard run that are missing
  uint64_t gained = 0;             // overlaps that the standard run does not have
  uint64_t undecided = 0;          // neither lost nor gained
  uint64_t events_moved = 0;       // begin and end events that happen in another frame
  double lost_worst = 0;           // depth of the deepest lost overlap
  double gained_worst = 0;         // separation of the most separate gained overlap
  double contact_error_worst = 0;  // of the separations of common overlaps
  double contact_error_p99 = 0;

  // The greatest of the lengths above.
  double worst() const;
};

// Compares a run with `standard`, which has one entry for each frame and must outlive the meter.
class DeviationMeter {
 public:
  explicit DeviationMeter(std::span<const FrameResults> standard) : standard_(standard) {}

  // Call after each step of the other run, which has the same bodies in the same places.
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
