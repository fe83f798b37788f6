#include "accuracy/tunnelling/tunnelling.h"

#include <algorithm>
#include <chrono>
#include <set>

#include "accuracy/scenes/trials.h"
#include "accuracy/tunnelling/meetings.h"
#include "carom/world/world.h"

namespace carom::accuracy {
namespace {

using Clock = std::chrono::steady_clock;
using Pairs = std::set<Pair>;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct Frame {
  std::vector<MovingBody> bodies;
  std::vector<PairMeeting> meetings;
};

std::vector<BodyDesc> without_sensors(std::vector<BodyDesc> bodies) {
  for (BodyDesc& body : bodies) body.sensor = false;
  return bodies;
}

void note_reference(const Frame& frame, size_t index, TunnellingReport& report) {
  for (const PairMeeting& meeting : frame.meetings) {
    if (meeting.time.meeting == Meeting::grazing) {
      report.grazing.push_back({index, meeting.pair, meeting.time.least, ""});
      continue;
    }
    ++report.meetings;
    if (meeting.time.by == 0) ++report.at_start;
  }
}

// --- One detection setting, played into a world ---

// The pairs that a world reported in a frame, and the time of its steps.
struct Sight {
  Pairs pairs;
  std::vector<Impact> impacts;
  double milliseconds = 0;
};

class Viewer {
 public:
  Viewer(const MovingScene& scene, const TunnellingOptions& options, Detection detection,
         int substeps)
      : excluded_(scene.excluded()), detection_(detection), substeps_(substeps) {
    WorldSettings settings;
    settings.positions = scene.positions();
    settings.parallelism = options.parallelism;
    settings.dt = scene.dt();
    settings.impacts = Impacts::all;
    world_ = World(settings);
  }

  Result<Sight> view(const Frame& frame) {
    Sight sight;
    // Discrete: the start of this frame is the end of the frame before, so its step is not timed.
    const bool in_substeps = detection_ == Detection::discrete;
    for (int k = 0; k <= (in_substeps ? substeps_ : 0); ++k) {
      const Result<double> milliseconds = step(frame, static_cast<double>(k) / substeps_);
      if (!milliseconds) return milliseconds.error();
      if (k > 0 || !in_substeps) sight.milliseconds += *milliseconds;
      note(sight);
    }
    return sight;
  }

 private:
  Result<double> step(const Frame& frame, double t) {
    if (ids_.empty()) {
      add(frame);
    } else {
      move(frame, t);
    }
    const Clock::time_point begin = Clock::now();
    const StepReport& report = world_.step();
    const double milliseconds = 1e3 * seconds_since(begin);
    if (report.search.complete) return milliseconds;
    return Error{"there are " + std::to_string(report.search.pairs) +
                 " pairs of overlapping bounds, more than the limit of " +
                 std::to_string(world_.settings().most_pairs)};
  }

  void add(const Frame& frame) {
    for (const MovingBody& body : frame.bodies) {
      BodyDesc desc = body.desc;
      if (desc.motion == Motion::dynamic) desc.detection = detection_;
      ids_.push_back(world_.add(desc));
    }
    world_.exclude(excluded_);
  }

  void move(const Frame& frame, double t) {
    for (size_t i = 0; i < ids_.size(); ++i) {
      const Pose pose = pose_at(frame.bodies[i], t);
      world_.set_position(ids_[i], pose.position);
      world_.set_orientation(ids_[i], pose.orientation);
      world_.set_linear_velocity(ids_[i], frame.bodies[i].desc.linear_velocity);
      world_.set_angular_velocity(ids_[i], frame.bodies[i].desc.angular_velocity);
    }
  }

  void note(Sight& sight) const {
    for (const Impact& impact : world_.impacts()) {
      sight.impacts.push_back(impact);
      sight.pairs.insert({impact.a, impact.b});
    }
    if (detection_ == Detection::continuous) return;
    for (const auto& contacts : {world_.contacts(), world_.speculative_contacts()}) {
      for (const Contact& contact : contacts) sight.pairs.insert({contact.a, contact.b});
    }
  }

  std::span<const Pair> excluded_;
  Detection detection_;
  int substeps_;
  World world_;
  std::vector<BodyId> ids_;
};

// --- Reported pairs compared with the true meetings ---

class Comparison {
 public:
  Comparison(const std::vector<Frame>& frames, TunnellingRow& row, TunnellingReport& report)
      : frames_(frames), row_(row), report_(report) {
    const bool finds_times =
        row.detection == Detection::continuous || row.detection == Detection::automatic;
    if (finds_times) row_.times.emplace();
  }

  void add(size_t index, const Sight& sight) {
    size_t known = 0;
    for (const PairMeeting& meeting : frames_[index].meetings) {
      const bool is_seen = sight.pairs.contains(meeting.pair);
      known += is_seen;
      if (meeting.time.meeting == Meeting::grazing) {
        row_.grazes += is_seen;
      } else {
        is_seen ? ++row_.seen : ++row_.missed;
        if (!is_seen) note_failure(index, meeting, "is missed");
      }
    }
    row_.unfounded += sight.pairs.size() - known;
    if (row_.times) compare_times(index, sight);
  }

 private:
  void note_failure(size_t index, const PairMeeting& meeting, const std::string& what) {
    if (row_.detection != Detection::continuous) return;
    report_.failures.push_back({index, meeting.pair, meeting.time.least, what});
  }

  void compare_times(size_t index, const Sight& sight) {
    const std::vector<PairMeeting>& meetings = frames_[index].meetings;
    for (const Impact& impact : sight.impacts) {
      const Pair pair{impact.a, impact.b};
      const auto at = std::lower_bound(
          meetings.begin(), meetings.end(), pair,
          [](const PairMeeting& meeting, const Pair& sought) { return meeting.pair < sought; });
      if (at == meetings.end() || at->pair != pair) continue;
      if (at->time.meeting == Meeting::certain) compare_time(index, *at, impact.toi);
    }
  }

  void compare_time(size_t index, const PairMeeting& meeting, double toi) {
    ImpactTimes& times = *row_.times;
    const double late = toi - meeting.time.by, early = meeting.time.until - toi;
    times.latest = std::max(times.latest, late);
    times.earliest = std::max(times.earliest, early);
    times.early_way = std::max(times.early_way, early * meeting.time.travel);
    if (late <= 0) return;
    ++times.late;
    note_failure(index, meeting, "is late by " + std::to_string(late) + " of the interval");
  }

  const std::vector<Frame>& frames_;
  TunnellingRow& row_;
  TunnellingReport& report_;
};

class Measurement {
 public:
  Measurement(const MovingScene& scene, const TunnellingOptions& options,
              const TunnellingProgress& progress)
      : scene_(scene), options_(options), progress_(progress) {
    for (const int substeps : options.substeps) add_row(Detection::discrete, substeps);
    for (const Detection detection :
         {Detection::swept, Detection::continuous, Detection::automatic}) {
      add_row(detection, 1);
    }
  }

  Result<TunnellingReport> run() {
    find_reference();
    for (int round = 0; round < options_.rounds; ++round) {
      for (size_t i = 0; i < report_.rows.size(); ++i) {
        progress(scene_.frames() + static_cast<size_t>(round) * report_.rows.size() + i);
        if (Result<void> played = play(i, round == 0); !played) return played.error();
      }
    }
    for (size_t i = 0; i < report_.rows.size(); ++i) {
      report_.rows[i].frame_ms = steady_mean(least_ms_[i]);
    }
    return std::move(report_);
  }

 private:
  void add_row(Detection detection, int substeps) {
    TunnellingRow& row = report_.rows.emplace_back();
    row.detection = detection;
    row.substeps = substeps;
  }

  void progress(size_t done) {
    const size_t plays = static_cast<size_t>(options_.rounds) * report_.rows.size();
    progress_(done, scene_.frames() + plays);
  }

  void find_reference() {
    const Clock::time_point begin = Clock::now();
    MeetingSearch search(options_.reference_substeps);
    report_.frames = scene_.frames();
    for (size_t i = 0; i < scene_.frames(); ++i) {
      progress(i);
      Frame& frame = frames_.emplace_back();
      frame.bodies = moving_bodies(without_sensors(scene_.bodies(i)), scene_.dt());
      frame.meetings = find_meetings(frame.bodies, scene_.excluded(), scene_.positions(), search);
      note_reference(frame, i, report_);
    }
    report_.poses = search.poses();
    report_.reference_seconds = seconds_since(begin);
    report_.bodies = frames_.front().bodies.size();
    for (const MovingBody& body : frames_.front().bodies) {
      report_.dynamic += body.desc.motion == Motion::dynamic;
    }
    least_ms_.assign(report_.rows.size(), std::vector<double>(frames_.size(), kNever));
  }

  Result<void> play(size_t row, bool compares) {
    TunnellingRow& result = report_.rows[row];
    Viewer viewer(scene_, options_, result.detection, result.substeps);
    std::optional<Comparison> comparison;
    if (compares) comparison.emplace(frames_, result, report_);
    for (size_t i = 0; i < frames_.size(); ++i) {
      const Result<Sight> sight = viewer.view(frames_[i]);
      if (!sight) {
        return Error{scene_.name() + ": frame " + std::to_string(i) + ": " + sight.error().message};
      }
      least_ms_[row][i] = std::min(least_ms_[row][i], sight->milliseconds);
      if (comparison) comparison->add(i, *sight);
    }
    return {};
  }

  const MovingScene& scene_;
  const TunnellingOptions& options_;
  const TunnellingProgress& progress_;
  std::vector<Frame> frames_;
  std::vector<std::vector<double>> least_ms_;  // of every row and frame
  TunnellingReport report_;
};

}  // namespace

Result<TunnellingReport> measure_tunnelling(const MovingScene& scene,
                                            const TunnellingOptions& options,
                                            const TunnellingProgress& progress) {
  return Measurement(scene, options, progress).run();
}

}  // namespace carom::accuracy
