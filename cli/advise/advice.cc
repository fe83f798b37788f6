#include "cli/advise/advice.h"

#include <algorithm>
#include <cmath>

#include "cli/run/world_options.h"
#include "cli/support/number_text.h"
#include "cli/support/options.h"

namespace carom::cli {
namespace {

using accuracy::Deviation;
using accuracy::Trial;

std::string metres(double value) { return number("%.3g m", value); }
std::string quoted(const std::string& word) {
  constexpr char kPlain[] =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=,+@%-";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string list;
  for (const std::string& part : parts) list += (list.empty() ? "" : between) + part;
  return list;
}

std::string counts_of(const Deviation& deviation) {
  return std::to_string(deviation.lost) + " overlaps lost, " + std::to_string(deviation.gained) +
         " gained, separations off by up to " + metres(deviation.contact_error_worst);
}

// "0.71 of the time; 0 overlaps lost, ...".
std::string outcome(const TriedSettings& tried) {
  if (!tried.result) return tried.name + ": no time was left to try it";
  const std::string time = tried.name + ": " + number("%.2f of the time", tried.ratio());
  const Deviation& deviation = tried.result->deviation;
  if (deviation.worst() == 0 && deviation.lost + deviation.gained == 0) return time;
  return time + ", " + counts_of(deviation);
}

std::string outcomes(const SettingsChoice& choice, SettingGroup group) {
  std::vector<std::string> parts;
  for (const TriedSettings& tried : choice.tried) {
    if (tried.group == group) parts.push_back(outcome(tried));
  }
  return joined(parts, "; ");
}

// The greatest error of the relative position of a pair: half a step per axis and body.
double float32_error(const SceneSurvey& survey) { return std::sqrt(3.0) * survey.float32_step; }

AdviceRow tier_row(const Advice& advice) {
  std::string reason = outcomes(advice.choice, SettingGroup::tier);
  if (advice.survey.pairs.pairs == 0) reason = "no pairs in the frames looked at";
  return {"tier", "standard", reason};
}

AdviceRow tolerance_row(const Advice& advice) {
  const float metres = advice.choice.chosen.settings.accuracy.tolerance;
  const std::string reason = outcomes(advice.choice, SettingGroup::tolerance);
  return {"tolerance", metres > 0 ? shortest(metres) + " m" : "none",
          reason.empty() ? "nothing moves" : reason};
}

AdviceRow broadphase_row(const Advice& advice) {
  const PairSearch& search = advice.choice.standard.search;
  const BroadphaseMethod chosen = advice.choice.chosen.settings.broadphase;
  const std::string automatic = std::string("auto is ") + name(search.method) + " here";
  const std::string others = outcomes(advice.choice, SettingGroup::broadphase);
  return {"broadphase", name(chosen), automatic + (others.empty() ? "" : "; " + others)};
}

AdviceRow margin_row(const Advice& advice) {
  const float margin = advice.choice.chosen.settings.margin;
  std::string reason = outcomes(advice.choice, SettingGroup::margin);
  if (reason.empty()) {
    reason = advice.survey.moving_share > 0 ? "bodies cross their own size in a few frames"
                                            : "nothing moves";
  }
  return {"margin", margin > 0 ? shortest(margin) + " m" : "0", reason};
}

AdviceRow dops_row(const Advice& advice) {
  const bool chosen = advice.choice.chosen.settings.dop_bounds.has_value();
  const std::string reason = outcomes(advice.choice, SettingGroup::dops);
  return {"bounds", chosen ? "14-DOPs" : "boxes",
          reason.empty() ? "k-DOPs are no tighter for these kinds" : reason};
}

AdviceRow cache_row(const Advice& advice) {
  const accuracy::StandardRun& run = advice.choice.standard;
  const double kept =
      run.candidates ? static_cast<double>(run.kept) / static_cast<double>(run.candidates) : 0;
  const std::string tried = outcomes(advice.choice, SettingGroup::cache);
  return {"cache", advice.choice.chosen.settings.carry_results ? "on" : "off",
          percent(kept) + " of the pairs kept their result" + (tried.empty() ? "" : "; " + tried)};
}

AdviceRow threads_row(const Advice& advice) {
  const std::string tried = outcomes(advice.choice, SettingGroup::threads);
  return {"threads", std::to_string(advice.choice.chosen.threads),
          tried.empty() ? "one is all there is" : tried};
}

AdviceRow positions_row(const Advice& advice) {
  const SceneSurvey& survey = advice.survey;
  const double error = float32_error(survey);
  const std::string step =
      "at " + metres(survey.farthest) + " floats are " + metres(survey.float32_step) +
      " apart, so that rounding positions moves a separation by up to " + metres(error);
  const bool fits = error <= advice.tolerance;
  if (survey.float64 && survey.fits_float32) {
    return {"positions", "float32",
            "every position of this scene is a float: float64 is for nothing"};
  }
  if (survey.float64) {
    return {"positions", fits ? "float32" : "float64",
            step + (fits ? ", within the tolerance" : ", beyond the tolerance")};
  }
  return {"positions", "float32",
          step + (fits ? ", within the tolerance"
                       : ", beyond the tolerance: if these were rounded, the scene needs float64")};
}

std::vector<AdviceRow> settings_of(const Advice& advice) {
  return {tier_row(advice), tolerance_row(advice), broadphase_row(advice), margin_row(advice),
          dops_row(advice), cache_row(advice),     threads_row(advice),    positions_row(advice)};
}

bool spheres_alone(const BodiesOfKind& kinds) {
  for (size_t kind = 0; kind < kinds.size(); ++kind) {
    const bool has_one_point = kind == static_cast<size_t>(ShapeKind::sphere) ||
                               kind == static_cast<size_t>(ShapeKind::halfspace);
    if (kinds[kind] > 0 && !has_one_point) return false;
  }
  return true;
}

uint64_t events_of(const accuracy::StandardRun& run) {
  uint64_t changes = 0;
  for (size_t f = 1; f < run.frames.size(); ++f) {
    changes += run.frames[f].overlaps != run.frames[f - 1].overlaps;
  }
  return changes;
}

std::vector<AdviceRow> not_needed(const Advice& advice) {
  const SceneSurvey& survey = advice.survey;
  const accuracy::StandardRun& run = advice.choice.standard;
  std::vector<AdviceRow> rows;
  const auto add = [&](bool is_so, const char* what, const char* reason) {
    if (is_so) rows.push_back({what, "", reason});
  };
  add(!survey.has_orientation, "orientations", "no body has a kind that turns, or none is turned");
  add(survey.all_unturned, "orientations",
      "no body is turned: aabbs instead of boxes give the same contacts");
  add(spheres_alone(survey.kinds), "manifolds",
      "a sphere touches in one point: detail contact says all");
  add(survey.frames > 1 && run.kept == 0, "cache", "no pair kept its result");
  add(survey.frames > 1 && survey.moving_share == 0, "margin, tolerance", "nothing moves");
  add(survey.frames > 1 && events_of(run) == 0, "events", "no overlap began or ended");
  add(!survey.has_velocities, "velocities", "the scene gives none");
  add(!survey.has_filters && survey.fixed == 0, "filters",
      "no layers, masks, owners, spaces, excluded pairs or static bodies");
  add(survey.sensors == 0, "sensors", "there are none");
  add(survey.pairs.pairs > 0 && survey.pairs.near == 0, "certified and exact tier",
      "no separation is within 2^-17 of the bodies' size");
  return rows;
}

}  // namespace

std::string run_command(const std::string& scene, const Trial& trial) {
  const RunSettings settings{.world = trial.settings};
  std::string command = "carom run " + quoted(scene) + WorldOptions().text_of(settings);
  if (trial.threads > 1) command += " --threads " + std::to_string(trial.threads);
  return command;
}

Advice advise(const std::string& scene, double tolerance, SceneSurvey survey,
              SettingsChoice choice) {
  Advice advice{.scene = scene,
                .tolerance = tolerance,
                .isa = name(active_isa()),
                .survey = std::move(survey),
                .choice = std::move(choice),
                .settings = {},
                .not_needed = {},
                .command = {},
                .front = {}};
  const double bound = advice.survey.pairs.error_bound;
  advice.meets = advice.choice.deviation.worst() + bound <= tolerance;
  advice.guaranteed_error = double{advice.choice.chosen.settings.accuracy.tolerance} + bound;
  advice.settings = settings_of(advice);
  advice.not_needed = not_needed(advice);
  advice.command = run_command(scene, advice.choice.chosen);
  return advice;
}

}  // namespace carom::cli
