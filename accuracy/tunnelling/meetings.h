// Finds all meetings of a frame's bodies in the following interval.
#pragma once

#include <span>
#include <vector>

#include "accuracy/tunnelling/meeting.h"
#include "carom/results/pair.h"

namespace carom::accuracy {

struct PairMeeting {
  Pair pair;
  MeetingTime time;
};

// Bodies with their movement over the next interval, as World defines it (WorldSettings::dt).
std::vector<MovingBody> moving_bodies(std::span<const BodyDesc> bodies, double dt);

// The meetings of dynamic bodies with everything they may meet, sorted by pair. Invalid bodies meet
// nothing, and the sorted pairs `excluded` do not meet. Tries every two bodies.
std::vector<PairMeeting> find_meetings(std::span<const MovingBody> bodies,
                                       std::span<const Pair> excluded, PositionType positions,
                                       MeetingSearch& search);

}  // namespace carom::accuracy
