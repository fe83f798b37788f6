#include "bench/peers/broadphase/comparison.h"

#include <algorithm>
#include <numeric>

#include "bench/support/measure.h"
#include "carom/broadphase/find_pairs.h"
#include "reference/pairs.h"

namespace carom::bench {
namespace {

constexpr size_t kMostForBruteForce = 10'000;
constexpr size_t kComparedFrames = 2;
constexpr size_t kFewestRounds = 3;
constexpr size_t kFramesPerTurn = 10;
constexpr double kTurnsPerBudget = 5;

std::string text(Pair pair) {
  return "(" + std::to_string(pair.a) + ", " + std::to_string(pair.b) + ")";
}

void sort(std::vector<Pair>& pairs) {
  for (Pair& pair : pairs) pair = {std::min(pair.a, pair.b), std::max(pair.a, pair.b)};
  std::sort(pairs.begin(), pairs.end());
}

// The first difference between two sorted lists; empty if there is none.
std::string difference(const std::vector<Pair>& got, const std::vector<Pair>& expected) {
  const auto [g, e] = std::mismatch(got.begin(), got.end(), expected.begin(), expected.end());
  if (e == expected.end()) return g == got.end() ? "" : text(*g) + " is no pair or there twice";
  return g == got.end() || *e < *g ? text(*e) + " is missing"
                                   : text(*g) + " is no pair or there twice";
}

std::vector<Pair> brute_force(const FrameBounds& frame) {
  std::vector<reference::Box> boxes;
  for (const Box& box : frame.boxes) {
    boxes.push_back(
        {{box.lower[0], box.lower[1], box.lower[2]}, {box.upper[0], box.upper[1], box.upper[2]}});
  }
  return reference::overlapping_pairs(boxes);
}

// Carom's results: the pairs of the compared frames and the number of pairs of all frames.
struct Expected {
  explicit Expected(const PeerScene& scene) {
    const std::unique_ptr<Peer> carom = carom_kinds().front().make(scene.frame(0), scene.world());
    std::vector<Pair> found;
    for (size_t i = 0; i < scene.frames(); ++i) {
      carom->update(scene.frame(i));
      carom->find(found);
      counts.push_back(found.size());
      if (i < kComparedFrames) pairs.push_back(found);
    }
  }

  std::vector<std::vector<Pair>> pairs;
  std::vector<size_t> counts;
};

class Contestant {
 public:
  Contestant(const PeerKind& kind, const PeerScene& scene) : scene_(scene), cycle_(scene.frames()) {
    result_.peer = kind.name;
    result_.threads = kind.threads;
  }

  bool plays() const { return result_.outcome == Outcome::timed; }
  bool is_yardstick() const { return result_.peer == kYardstick; }
  double seconds() const { return std::accumulate(times_.begin(), times_.end(), 0.0); }
  size_t frames() const { return times_.size(); }

  void drop(Outcome outcome, std::string detail) {
    result_.outcome = outcome;
    result_.detail = std::move(detail);
    peer_.reset();
  }

  // Makes the peer and compares its pairs in the first frames.
  void compare(const PeerKind& kind, const Expected& expected, double frame_limit) {
    peer_ = kind.make(scene_.frame(0), scene_.world());
    for (size_t frame = 0; frame < kComparedFrames && plays(); ++frame) {
      const double seconds = play(frame);
      sort(pairs_);
      const std::string found = difference(pairs_, expected.pairs[frame]);
      if (!found.empty()) {
        drop(Outcome::different, "frame " + std::to_string(frame) + ": " + found);
      } else if (seconds > frame_limit && !is_yardstick()) {
        drop(Outcome::too_slow, "a frame took " + std::to_string(seconds) + " s");
      }
    }
    for (size_t frame = 0; frame + 1 < kComparedFrames; ++frame) cycle_.next();
  }

  // Times some frames, fewer if they take long. The first is not timed, because the peer before has
  // filled the caches.
  void take_turn(double most_seconds, const Expected& expected) {
    play_checked(expected);
    double used = 0;
    for (size_t i = 0; i < kFramesPerTurn && used < most_seconds && plays(); ++i) {
      times_.push_back(play_checked(expected));
      used += times_.back();
    }
  }

  PeerResult result() {
    result_.frames = times_.size();
    if (!plays() || times_.empty()) return result_;
    std::sort(times_.begin(), times_.end());
    result_.least_seconds = times_.front();
    result_.median_seconds = times_[times_.size() / 2];
    return result_;
  }

 private:
  double play(size_t frame) {
    const FrameBounds bounds = scene_.frame(frame);
    const Stopwatch watch;
    peer_->update(bounds);
    peer_->find(pairs_);
    return watch.seconds();
  }

  // Plays the next frame and checks its number of pairs.
  double play_checked(const Expected& expected) {
    const size_t frame = cycle_.next();
    const double seconds = play(frame);
    const size_t count = expected.counts[frame];
    if (pairs_.size() != count) {
      drop(Outcome::different, "frame " + std::to_string(frame) + ": " +
                                   std::to_string(pairs_.size()) + " pairs, not " +
                                   std::to_string(count));
    }
    return seconds;
  }

  const PeerScene& scene_;
  std::unique_ptr<Peer> peer_;
  FrameCycle cycle_;
  std::vector<Pair> pairs_;
  std::vector<double> times_;
  PeerResult result_;
};

// Why the peer is not tried at all; empty if it is.
std::string foreseen(const PeerKind& kind, const PeerScene& scene, const TimeLimits& limits,
                     const SmallerScene& smaller) {
  if (scene.bodies() > kind.most_bodies) return "too many bodies for it";
  const auto known = smaller.find(kind.name);
  if (known == smaller.end() || 10 * known->second <= limits.frame_limit) return "";
  return kind.name == std::string(kYardstick) ? "" : "from the time of a tenth of the bodies";
}

// Times the peers in turns, so that a drift of the machine's clock affects all of them. Ends when
// the yardstick has used its budget; a peer that has used its own skips the remaining turns.
void time_in_turns(std::vector<Contestant>& contestants, const TimeLimits& limits,
                   const Expected& expected) {
  const auto yardstick = std::find_if(contestants.begin(), contestants.end(),
                                      [](const Contestant& c) { return c.is_yardstick(); });
  const auto has_enough = [&](const Contestant& c) {
    return !c.plays() || (c.seconds() >= limits.budget && c.frames() >= kFewestRounds);
  };
  for (size_t round = 0; round < kFewestRounds || !has_enough(*yardstick); ++round) {
    for (Contestant& contestant : contestants) {
      if (has_enough(contestant)) continue;
      contestant.take_turn(limits.budget / kTurnsPerBudget, expected);
    }
  }
}

}  // namespace

const PeerResult* SceneResult::timed(const std::string& peer) const {
  const auto found = std::find_if(peers.begin(), peers.end(), [&](const PeerResult& result) {
    return result.peer == peer && result.threads == 1 && result.outcome == Outcome::timed;
  });
  return found == peers.end() ? nullptr : &*found;
}

bool SceneResult::all_equal() const {
  return brute_force.empty() && std::none_of(peers.begin(), peers.end(), [](const PeerResult& r) {
           return r.outcome == Outcome::different;
         });
}

SceneResult compare(const PeerScene& scene, const std::vector<PeerKind>& kinds,
                    const TimeLimits& limits, const SmallerScene& smaller) {
  const Expected expected(scene);
  SceneResult result;
  result.scene = scene.name();
  result.bodies = scene.bodies();
  result.pairs = expected.counts[1];
  result.held_to_brute_force = scene.bodies() <= kMostForBruteForce;
  for (size_t i = 0; result.held_to_brute_force && i < kComparedFrames; ++i) {
    const std::string found = difference(expected.pairs[i], brute_force(scene.frame(i)));
    if (found.empty()) continue;
    result.brute_force = "frame " + std::to_string(i) + ": " + found;
    return result;
  }

  std::vector<Contestant> contestants;
  for (const PeerKind& kind : kinds) {
    Contestant& contestant = contestants.emplace_back(kind, scene);
    const std::string reason = foreseen(kind, scene, limits, smaller);
    if (reason.empty()) {
      contestant.compare(kind, expected, limits.frame_limit);
    } else {
      contestant.drop(Outcome::too_slow, reason);
    }
  }
  time_in_turns(contestants, limits, expected);
  for (Contestant& contestant : contestants) result.peers.push_back(contestant.result());
  return result;
}

}  // namespace carom::bench
