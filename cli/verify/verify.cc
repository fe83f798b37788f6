// carom verify: compares everything with the scalar reference, bit for bit.
#include "cli/verify/verify.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/scenes/scene_source.h"
#include "cli/support/command_line.h"
#include "cli/support/options.h"
#include "cli/support/table.h"
#include "cli/verify/verify_builtin.h"
#include "cli/verify/verify_impacts.h"
#include "cli/verify/verify_pairs.h"
#include "cli/verify/verify_scene.h"
#include "io/files/npz.h"
#include "io/printable.h"

namespace carom::cli {
namespace {

bool names_pairs(const std::string& source) {
  if (names_generator(source) || io::has_extension(source, ".aabb") ||
      io::has_extension(source, ".aabbs")) {
    return false;
  }
  Result<io::NpzReader> reader = io::NpzReader::open(source);
  return reader && reader->has("pair_shape_a");
}

int default_threads() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 2, 8);
}

class Verification {
 public:
  Verification(System& system, const VerifyOptions& options, const Console& console)
      : system_(system),
        options_(options),
        console_(console),
        engines_(options.threads.value_or(default_threads())) {}

  void verify_source(const std::string& source) {
    const std::string label = io::printable(source);
    if (names_pairs(source)) {
      Result<PairSet> pairs = read_pair_set(source);
      if (!note(pairs ? verify_pairs(system_, engines_, *pairs, label, console_) : pairs.error())) {
        return;
      }
      if (pairs->has_motions()) {
        note(verify_impacts(system_, engines_, *pairs, label, console_));
      }
    } else {
      Result<std::unique_ptr<io::SceneReader>> scene = open_source(source);
      note(scene ? verify(**scene, label) : scene.error());
    }
  }

  void verify_builtin() {
    for (BuiltinScene& builtin : builtin_scenes()) {
      if (!note(verify(*builtin.scene, builtin.name))) return;
    }
    for (const BuiltinPairs& builtin : builtin_pairs()) {
      if (!note(verify_pairs(system_, engines_, builtin.pairs, builtin.name, console_))) return;
    }
    for (const BuiltinPairs& builtin : builtin_motions()) {
      if (!note(verify_impacts(system_, engines_, builtin.pairs, builtin.name, console_))) return;
    }
  }

  bool differs() const { return difference_.has_value(); }

  // Prints the findings and returns the exit code.
  int finish() const {
    if (rows_ > 0) table_.print(console_.out);
    for (const auto& [what, sources] : compared_) {
      console_.out << "\nCompared (" << sources << "):\n  " << what << '\n';
    }
    if (difference_) {
      console_.out << "\n" << difference_->where << '\n' << difference_->text;
      console_.error({"verify: " + difference_->where});
    } else if (!failed_) {
      console_.out << "\nEverything agrees with the scalar reference, bit for bit.\n";
    }
    return failed_ || difference_ ? 1 : 0;
  }

 private:
  Result<VerifyOutcome> verify(io::SceneReader& scene, const std::string& source) {
    uint64_t frames = options_.frames ? options_.frames : scene.info().frames;
    return verify_scene(system_, engines_, scene, source, frames, console_);
  }

  // Notes an outcome; returns whether it could be verified and agreed.
  bool note(Result<VerifyOutcome> outcome) {
    if (!outcome) {
      failed_ = true;
      console_.error(outcome.error());
      return false;
    }
    note_compared(outcome->compared, outcome->source);
    for (const VerifyRow& row : outcome->rows) {
      ++rows_;
      table_.add({outcome->source, name(row.engine.isa), std::to_string(row.engine.threads),
                  "standard", std::to_string(row.frames), std::to_string(row.pairs),
                  std::to_string(row.overlaps), row.differs ? "DIFFERS" : "same bits"});
    }
    if (!outcome->difference) return true;
    difference_ = std::move(outcome->difference);
    difference_->where = outcome->source + ": " + difference_->where;
    return false;
  }

  // Many sources have the same list.
  void note_compared(const std::string& what, const std::string& source) {
    for (auto& [known, sources] : compared_) {
      if (known != what) continue;
      sources += ", " + source;
      return;
    }
    compared_.emplace_back(what, source);
  }

  System& system_;
  const VerifyOptions& options_;
  const Console& console_;
  Engines engines_;
  Table table_{{"source", "ISA", "threads", "tier", "frames", "pairs", "overlaps", "verdict"}};
  // Each list of what was compared, and of which sources.
  std::vector<std::pair<std::string, std::string>> compared_;
  size_t rows_ = 0;
  bool failed_ = false;  // a source could not be read
  std::optional<Difference> difference_;
};

}  // namespace

Result<int> verify(const VerifyOptions& options, System& system, const Console& console) {
  if (options.threads) {
    if (Result<void> threads = check_threads(*options.threads); !threads) return threads.error();
  }
  Verification verification(system, options, console);
  if (options.sources.empty()) verification.verify_builtin();
  for (const std::string& source : options.sources) {
    verification.verify_source(source);
    if (verification.differs()) break;
  }
  return verification.finish();
}

void add_verify_command(CommandLine& program) {
  auto options = std::make_shared<VerifyOptions>();
  Command command =
      program.add_command("verify", "Compare every instruction set with the scalar reference");
  command.add_option("SCENE|PAIRS", options->sources,
                     "Scenes, generators and files of pairs; a built-in set if there are none");
  command.add_option("--frames", options->frames, "Frames of every scene; all if not given")
      .between(uint64_t{1}, uint64_t{1'000'000'000});
  command.add_option("--threads", options->threads,
                     "Verify 1 to this many threads; if not given, those of the machine, 2 to 8");
  command.run([options](const Console& console) {
    System system;
    return verify(*options, system, console);
  });
}

}  // namespace carom::cli
