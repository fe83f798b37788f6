#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "cli/advise/advice.h"
#include "cli/commands.h"
#include "cli/support/command_line.h"
#include "cli/support/json_output.h"
#include "cli/support/number_text.h"
#include "cli/support/options.h"
#include "cli/support/progress.h"

namespace carom::cli {
namespace {

using Clock = std::chrono::steady_clock;

// For all trials together.
constexpr std::chrono::seconds kBudget(20);
constexpr size_t kFirstFrames = 3;
constexpr int kMostRounds = 8;

struct AdviseOptions {
  std::string scene;
  double tolerance = 0;
  uint64_t frames = 30;
  int threads = 0;  // 0: as many as the machine has
  bool front = false;
  std::string json;
};

Result<void> check(const AdviseOptions& options) {
  if (Result<void> metres = check_metres("--tolerance", options.tolerance); !metres) return metres;
  if (!(static_cast<float>(options.tolerance) > 0)) {
    return Error{"--tolerance" + number(" %g", options.tolerance) +
                 ": not a number of metres above 0"};
  }
  return options.threads == 0 ? Result<void>() : check_threads(options.threads);
}

int threads_of(const AdviseOptions& options) {
  if (options.threads > 0) return options.threads;
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMaxThreads);
}

Result<Advice> advise_scene(const AdviseOptions& options, const Console& console) {
  const Clock::time_point begin = Clock::now();
  Progress progress(console, options.scene + ": second", kBudget.count());
  Result<std::unique_ptr<LoadedScene>> scene = LoadedScene::open(options.scene);
  if (!scene) return scene.error();
  LoadedScene& loaded = **scene;
  if (Result<void> read = loaded.load(std::min(kFirstFrames, options.frames)); !read) {
    return read.error();
  }
  const Result<size_t> frames = affordable_frames(loaded, kBudget, options.frames);
  if (!frames) return frames.error();
  if (Result<void> read = loaded.load(*frames); !read) return read.error();

  Result<SceneSurvey> surveyed = survey(loaded);
  if (!surveyed) return surveyed.error();
  const double model_error = error_within(options.tolerance);
  if (model_error > 0 && std::isfinite(model_error)) {
    if (auto ladders = loaded.add_ladders({&model_error, 1}); !ladders) return ladders.error();
  }
  TrialLimits limits{.tolerance = options.tolerance, .threads = threads_of(options), .plan = {}};
  limits.plan.rounds = kMostRounds;
  limits.plan.deadline = Clock::now() + kBudget;
  limits.plan.before_run = [&] {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - begin);
    progress.update(static_cast<uint64_t>(seconds.count()));
  };
  Result<SettingsChoice> choice = choose_settings(loaded, *surveyed, limits);
  if (!choice) return choice.error();
  std::vector<FrontPoint> front;
  if (options.front) {
    limits.plan.deadline = Clock::now() + kBudget;
    auto measured = measure_front(loaded, *surveyed, choice->standard, limits.plan);
    if (!measured) return measured.error();
    front = std::move(*measured);
  }
  Advice advice =
      advise(options.scene, options.tolerance, std::move(*surveyed), std::move(*choice));
  advice.front = std::move(front);
  return advice;
}

Result<int> run_advise(const AdviseOptions& options, const Console& console) {
  if (Result<void> checked = check(options); !checked) return checked.error();
  Result<JsonOutput> json = JsonOutput::open(options.json);
  if (!json) return json.error();
  Result<Advice> advice = advise_scene(options, console);
  if (!advice) return advice.error();
  Result<void> written = write_advice(*advice, *json, console);
  return written ? Result<int>(0) : written.error();
}

}  // namespace

void add_advise_command(CommandLine& program) {
  auto options = std::make_shared<AdviseOptions>();
  Command command =
      program.add_command("advise", "Measure a scene and name the cheapest settings for it");
  command.add_option("SCENE", options->scene, "A .npz or .aabb file, or a generator").required();
  command
      .add_option("--tolerance", options->tolerance,
                  "Metres by which separations and decisions may be off")
      .required();
  command.add_option("--frames", options->frames, "Frames to look at, at most")
      .between(uint64_t{1}, uint64_t{1'000'000'000})
      .show_default();
  command.add_option("--threads", options->threads,
                     "Threads to try, beside one; those of the machine if not given");
  command.add_flag("--front", options->front,
                   "Also measure tolerances from 1e-7 to 1e-1 of the radius, and list those that "
                   "nothing beats in both time and guaranteed error");
  add_json_option(command, options->json);
  command.run([options](const Console& console) { return run_advise(*options, console); });
}

}  // namespace carom::cli
