// All meetings of the bodies of a frame in the interval ahead.
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

// How bodies go on from where they are, as World says (WorldSettings::dt).
std::vector<MovingBody> moving_bodies(std::span<const BodyDesc> bodies, double dt);

// Of the dynamic bodies with everything that they may meet, sorted by pair; what is not valid meets
// nothing. Every two bodies are looked at.
std::vector<PairMeeting> find_meetings(std::span<const MovingBody> bodies, PositionType positions,
                                       MeetingSearch& search);

}  // namespace carom::accuracy
