#include "cli/advise/settings_trial.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>

namespace carom::cli {
namespace {

using accuracy::Trial;
using accuracy::TrialResult;
using Clock = std::chrono::steady_clock;
using Apply = std::function<void(Trial&)>;

constexpr double kRunsOfAScene = 50;  // about as many as all trials together run
constexpr size_t kLeastFrames = 4;
constexpr uint64_t kMostForBrute = 5000;  // bodies

// A change of settings that may save time.
struct Candidate {
  SettingGroup group;
  std::string name;
  Apply apply;
};

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

// Whether shapes exist that may fill little of their bounding boxes.
bool has_slanted_shapes(const SceneSurvey& survey) {
  constexpr ShapeKind kSlanted[] = {
      ShapeKind::box,       ShapeKind::capsule,     ShapeKind::triangle,
      ShapeKind::hull,      ShapeKind::cylinder,    ShapeKind::cone,
      ShapeKind::ellipsoid, ShapeKind::rounded_box, ShapeKind::rounded_hull};
  return std::any_of(std::begin(kSlanted), std::end(kSlanted),
                     [&](ShapeKind kind) { return survey.kinds[static_cast<size_t>(kind)] > 0; });
}

bool moves(const SceneSurvey& survey) { return survey.frames > 1 && survey.moving_share > 0; }

void add_broadphases(const SceneSurvey& survey, BroadphaseMethod automatic,
                     std::vector<Candidate>& candidates) {
  for (const BroadphaseMethod method :
       {BroadphaseMethod::grid, BroadphaseMethod::sweep, BroadphaseMethod::brute}) {
    const bool is_too_slow = method == BroadphaseMethod::brute && survey.bodies > kMostForBrute;
    if (method == automatic || is_too_slow) continue;
    candidates.push_back({SettingGroup::broadphase, std::string("broadphase ") + name(method),
                          [=](Trial& trial) { trial.settings.broadphase = method; }});
  }
}

// Margins that a median body crosses in 8 or 32 frames, up to the median radius.
void add_margins(const SceneSurvey& survey, std::vector<Candidate>& candidates) {
  if (!moves(survey)) return;
  for (const double frames : {8.0, 32.0}) {
    const std::string metres = text("%.2g", frames * survey.displacement.median);
    const float margin = std::strtof(metres.c_str(), nullptr);
    if (!(margin > 0) || margin > survey.radius.median) continue;
    candidates.push_back({SettingGroup::margin, "margin " + metres,
                          [=](Trial& trial) { trial.settings.margin = margin; }});
  }
}

// Candidates that do not change any result.
std::vector<Candidate> lossless_candidates(const SceneSurvey& survey, BroadphaseMethod automatic,
                                           int threads) {
  std::vector<Candidate> candidates;
  if (survey.frames > 1) {
    candidates.push_back({SettingGroup::cache, "no cache",
                          [](Trial& trial) { trial.settings.carry_results = false; }});
  }
  add_broadphases(survey, automatic, candidates);
  add_margins(survey, candidates);
  if (has_slanted_shapes(survey) && survey.pairs.pairs > 0) {
    candidates.push_back({SettingGroup::dops, "14-DOPs as bounds",
                          [](Trial& trial) { trial.settings.dop_bounds = DopKind::k14; }});
  }
  if (threads > 1) {
    candidates.push_back({SettingGroup::threads, std::to_string(threads) + " threads",
                          [=](Trial& trial) { trial.threads = threads; }});
  }
  return candidates;
}

Candidate tier(const std::string& name, Tier tier) {
  return {SettingGroup::tier, name, [=](Trial& trial) { trial.settings.accuracy.tier = tier; }};
}

std::vector<Candidate> tier_candidates(const SceneSurvey& survey, double tolerance) {
  std::vector<Candidate> candidates;
  if (survey.pairs.pairs == 0) return candidates;
  const auto metres = static_cast<float>(tolerance);
  if (moves(survey) && metres > 0 && std::isfinite(metres)) {
    candidates.push_back(
        {SettingGroup::tolerance, text("tolerance %.3g", metres), [=](Trial& trial) {
           trial.settings.carry_results = true;  // otherwise there are no results to keep
           trial.settings.accuracy.tolerance = metres;
         }});
  }
  candidates.push_back(tier("certified", Tier::certified));
  if (survey.all_decided_exactly) candidates.push_back(tier("exact", Tier::exact));
  return candidates;
}

class SettingsSearch {
 public:
  SettingsSearch(const LoadedScene& scene, const SceneSurvey& survey, const TrialLimits& limits)
      : scene_(scene), survey_(survey), limits_(limits), begin_(Clock::now()) {}

  Result<SettingsChoice> run() {
    Result<accuracy::StandardRun> standard = accuracy::run_standard(scene_);
    if (!standard) return standard.error();
    choice_.standard = std::move(*standard);
    choice_.chosen = {.name = "standard", .settings = {}};
    choice_.tried.push_back({SettingGroup::standard, "standard", choice_.chosen, {}, 0, 0, true});

    const auto lossless =
        lossless_candidates(survey_, choice_.standard.search.method, limits_.threads);
    if (Result<void> done = improve(lossless, 0.4); !done) return done.error();
    const auto tiers = tier_candidates(survey_, limits_.tolerance);
    if (Result<void> done = improve(tiers, 0.8); !done) return done.error();
    if (Result<void> done = settle(); !done) return done.error();
    return std::move(choice_);
  }

 private:
  // The time at which this part of the budget is spent.
  Clock::time_point deadline(double part) const {
    const std::chrono::duration<double> all = limits_.plan.deadline - begin_;
    return begin_ + std::chrono::duration_cast<Clock::duration>(part * all);
  }

  Result<std::vector<std::optional<TrialResult>>> run(const std::vector<Trial>& trials,
                                                      double until) {
    accuracy::TrialPlan plan = limits_.plan;
    plan.deadline = deadline(until);
    return accuracy::run_trials(scene_, choice_.standard, trials, plan);
  }

  // Times the candidates in turns with the present choice; combine() then adds the best of each
  // group to it.
  Result<void> improve(const std::vector<Candidate>& candidates, double until) {
    std::vector<Trial> trials = {choice_.chosen};
    for (const Candidate& candidate : candidates) {
      trials.push_back(choice_.chosen);
      trials.back().name = candidate.name;
      candidate.apply(trials.back());
    }
    auto results = run(trials, until);
    if (!results) return results.error();
    const std::optional<TrialResult>& present = results->front();
    if (!choice_.tried.front().result) choice_.tried.front().result = present;
    for (size_t i = 0; i < candidates.size(); ++i) {
      note(candidates[i], trials[i + 1], (*results)[i + 1], present.value_or(TrialResult{}));
    }
    return combine(candidates, until + 0.1);
  }

  void note(const Candidate& candidate, const Trial& trial,
            const std::optional<TrialResult>& result, const TrialResult& beside) {
    const bool meets = result && result->deviation.worst() <= limits_.tolerance;
    choice_.tried.push_back(
        {candidate.group, candidate.name, trial, result, beside.frame_ms, beside.tested, meets});
  }

  static bool pays(const TriedSettings& tried) {
    if (tried.group == SettingGroup::tier || !tried.result || !tried.meets) return false;
    const bool keeps_nothing = tried.result->tested >= tried.tested_beside;
    if (tried.group == SettingGroup::tolerance && keeps_nothing) return false;
    const double saved = tried.frame_ms_beside - tried.result->frame_ms;
    return saved > kWorthwhile * tried.frame_ms_beside && saved > kWorthwhileMs;
  }

  // A faster candidate of the same group, or null.
  const TriedSettings* rival(const TriedSettings& tried, size_t first) const {
    const auto is_better = [&](const TriedSettings& other) {
      return &other != &tried && other.group == tried.group && pays(other) &&
             other.ratio() < tried.ratio();
    };
    const auto begin = choice_.tried.begin() + static_cast<std::ptrdiff_t>(first);
    const auto found = std::find_if(begin, choice_.tried.end(), is_better);
    return found == choice_.tried.end() ? nullptr : &*found;
  }

  // Combines all of the last candidates.size() tried settings that pay. The combination becomes the
  // choice if it meets the tolerance and is faster than the fastest single one; otherwise that one
  // does.
  Result<void> combine(const std::vector<Candidate>& candidates, double until) {
    const size_t first = choice_.tried.size() - candidates.size();
    const TriedSettings* fastest = nullptr;
    Trial together = choice_.chosen;
    std::string names;
    size_t count = 0;
    for (size_t i = 0; i < candidates.size(); ++i) {
      const TriedSettings& tried = choice_.tried[first + i];
      if (!pays(tried) || rival(tried, first)) continue;
      candidates[i].apply(together);
      names += (count++ ? ", " : "") + tried.name;
      if (!fastest || tried.ratio() < fastest->ratio()) fastest = &tried;
    }
    if (!fastest) return {};
    const Trial best = fastest->trial;
    choice_.chosen = best;
    if (count == 1) return {};
    together.name = names;
    const std::vector<Trial> trials = {best, together};
    auto results = run(trials, until);
    if (!results) return results.error();
    if (!(*results)[0]) return {};
    note({SettingGroup::together, names, {}}, together, (*results)[1], *(*results)[0]);
    const TriedSettings& both = choice_.tried.back();
    if (both.result && both.meets && both.ratio() < 1) choice_.chosen = together;
    return {};
  }

  // Times the final choice against the default even after the deadline. The default wins unless the
  // choice is faster.
  Result<void> settle() {
    const std::vector<Trial> trials = {choice_.tried.front().trial, choice_.chosen};
    accuracy::TrialPlan plan = limits_.plan;
    if (Clock::now() > plan.deadline) plan.rounds = 1;
    plan.deadline = Clock::time_point::max();
    auto results = accuracy::run_trials(scene_, choice_.standard, trials, plan);
    if (!results) return results.error();
    const TrialResult& standard = *(*results)[0];
    const TrialResult& chosen = *(*results)[1];
    const bool pays = chosen.frame_ms < standard.frame_ms;
    if (!pays) choice_.chosen = trials.front();
    choice_.frame_ms_standard = standard.frame_ms;
    choice_.frame_ms = pays ? chosen.frame_ms : standard.frame_ms;
    choice_.deviation = pays ? chosen.deviation : standard.deviation;
    if (!choice_.tried.front().result) choice_.tried.front().result = standard;
    return {};
  }

  const LoadedScene& scene_;
  const SceneSurvey& survey_;
  TrialLimits limits_;
  Clock::time_point begin_;
  SettingsChoice choice_;
};

}  // namespace

Result<size_t> affordable_frames(const LoadedScene& scene, std::chrono::duration<double> budget,
                                 size_t most) {
  const Clock::time_point begin = Clock::now();
  const auto run = accuracy::run_standard(scene);
  if (!run) return run.error();
  const std::chrono::duration<double> each =
      (Clock::now() - begin) / static_cast<double>(scene.frames());
  const auto affordable =
      static_cast<size_t>(std::min(budget / (kRunsOfAScene * each), static_cast<double>(most)));
  return std::clamp(affordable, std::min(kLeastFrames, most), most);
}

Result<SettingsChoice> choose_settings(const LoadedScene& scene, const SceneSurvey& survey,
                                       const TrialLimits& limits) {
  return SettingsSearch(scene, survey, limits).run();
}

}  // namespace carom::cli
