// carom_peers [--smoke | --large] [--max-bodies N] [--pairs N] [--peers NAME] [--streams NAME]
//             [--budget S] [--frame-limit S] [--out FILE.json] [RECORDING.aabb...]
// Compares Carom with other libraries, in one run: the broadphase on generated scenes of 1k, 10k
// and 100k bodies and on recordings of bounds, the narrow phase on streams of pairs.
//   --smoke          1k bodies, a few frames, 2000 pairs: checks that everything still runs
//   --large          also a million bodies
//   --max-bodies N   most bodies of generated scenes; 0: recordings only
//   --pairs N        pairs of a stream (100000); 0: no narrow phase
//   --peers NAME     only Carom, CGAL and the broadphases whose names begin with NAME: bullet; cgal
//   --streams NAME   only streams whose names begin with NAME: hull_hull
//   --budget S       seconds of frames a peer and scene, and of passes a runner and stream (1)
//   --frame-limit S  a peer with a slower frame is left out (5)
//   --out FILE       the results as JSON
// Exit code 1 if a peer or Carom finds wrong pairs or decides wrongly.
#include <charconv>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "bench/peers/broadphase/comparison.h"
#include "bench/peers/broadphase/report.h"
#include "bench/peers/narrowphase/comparison.h"
#include "bench/peers/narrowphase/report.h"
#include "bench/peers/report.h"

namespace carom::bench {
namespace {

struct Arguments {
  TimeLimits limits;
  size_t max_bodies = 100'000;
  size_t pairs = 100'000;
  std::string peers;
  std::string streams;
  std::string out;
  std::vector<std::string> recordings;
};

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= 0;
}

// Parses the value of a flag that has one; false for other flags and bad values.
bool take_value(std::string_view flag, std::string_view value, Arguments& arguments) {
  if (flag == "--max-bodies") return parse(value, arguments.max_bodies);
  if (flag == "--pairs") return parse(value, arguments.pairs);
  if (flag == "--budget") return parse(value, arguments.limits.budget);
  if (flag == "--frame-limit") return parse(value, arguments.limits.frame_limit);
  std::string* const text = flag == "--out"       ? &arguments.out
                            : flag == "--peers"   ? &arguments.peers
                            : flag == "--streams" ? &arguments.streams
                                                  : nullptr;
  if (text != nullptr) *text = value;
  return text != nullptr;
}

std::optional<Arguments> parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--smoke") {
      arguments.max_bodies = 1'000;
      arguments.pairs = 2'000;
      arguments.limits.budget = 0.01;
    } else if (argument == "--large") {
      arguments.max_bodies = 1'000'000;
    } else if (!argument.starts_with("--")) {
      arguments.recordings.emplace_back(argument);
    } else if (i + 1 == argc || !take_value(argument, argv[++i], arguments)) {
      std::fprintf(stderr, "carom_peers: %s: unknown, or its value is missing or wrong\n",
                   argument.data());
      return std::nullopt;
    }
  }
  return arguments;
}

// Carom, the yardstick, and the others whose names begin so. Nothing if no name does.
std::vector<PeerKind> kinds_named(std::string_view beginning) {
  std::vector<PeerKind> named = carom_kinds();
  bool any = false;
  for (const auto& kinds : {cgal_kinds(), bullet_kinds(), fcl_kinds(), ode_kinds()}) {
    for (const PeerKind& kind : kinds) {
      const bool is_meant = std::string_view(kind.name).starts_with(beginning);
      if (is_meant || std::string_view(kind.name) == kYardstick) named.push_back(kind);
      any = any || is_meant;
    }
  }
  return any ? named : std::vector<PeerKind>();
}

// Median times on one thread; infinity for peers that are too slow.
SmallerScene medians(const SceneResult& result) {
  SmallerScene medians;
  for (const PeerResult& peer : result.peers) {
    if (peer.threads > 1 || peer.outcome == Outcome::different) continue;
    const bool timed = peer.outcome == Outcome::timed;
    medians[peer.peer] = timed ? peer.median_seconds : std::numeric_limits<double>::infinity();
  }
  return medians;
}

class BroadphaseComparison {
 public:
  BroadphaseComparison(const TimeLimits& limits, const std::vector<PeerKind>& kinds)
      : limits_(limits), kinds_(kinds) {}

  const SceneResult& run(const PeerScene& scene, const SmallerScene& smaller) {
    results_.push_back(compare(scene, kinds_, limits_, smaller));
    print(results_.back());
    return results_.back();
  }

  void run_generated(size_t max_bodies) {
    for (const char* generator : {"brownian", "varied", "static", "still"}) {
      SmallerScene smaller;
      for (const size_t bodies : scene_sizes(max_bodies)) {
        smaller = medians(run(PeerScene(SceneSpec{generator, bodies}), smaller));
      }
    }
  }

  Result<void> run_recording(const std::string& path) {
    const Result<PeerScene> scene = PeerScene::open(path);
    if (!scene) return scene.error();
    run(*scene, {});
    return {};
  }

  const std::vector<SceneResult>& results() const { return results_; }

 private:
  TimeLimits limits_;
  std::vector<PeerKind> kinds_;
  std::vector<SceneResult> results_;
};

std::vector<StreamResult> compare_streams(const std::string& names, size_t pairs, double budget) {
  std::vector<StreamResult> results;
  for (const PeerStreamSpec& spec : peer_streams()) {
    if (!spec.name().starts_with(names)) continue;
    results.push_back(compare(spec, pairs, budget));
    print(results.back());
  }
  return results;
}

int fail(const Error& error) {
  std::fprintf(stderr, "carom_peers: %s\n", error.message.c_str());
  return 1;
}

// Returns the exit code; the report shows the differences.
int check(const Comparisons& comparisons) {
  for (const SceneResult& result : comparisons.scenes) {
    if (!result.all_equal()) return fail({result.scene + ": pairs differ"});
  }
  for (const StreamResult& result : comparisons.streams) {
    if (!result.agrees()) return fail({result.pair + ": decisions differ"});
  }
  for (const ExactResult& result : comparisons.exact) {
    if (result.different > 0) return fail({result.pair + ": exact decisions differ"});
  }
  return 0;
}

int run(const Arguments& arguments) {
  const std::vector<PeerKind> kinds = kinds_named(arguments.peers);
  if (kinds.empty()) return fail({arguments.peers + ": no peer's name begins so"});
  Comparisons comparisons = {arguments.limits, {}, {}, {}};
  // First, since Bullet's narrow phase is four times as slow once its broadphases have run.
  if (arguments.pairs > 0) {
    comparisons.streams =
        compare_streams(arguments.streams, arguments.pairs, arguments.limits.budget);
    comparisons.exact = compare_exact(arguments.streams, arguments.pairs, arguments.limits.budget);
    for (const ExactResult& result : comparisons.exact) print(result);
  }
  BroadphaseComparison broadphase(arguments.limits, kinds);
  broadphase.run_generated(arguments.max_bodies);
  for (const std::string& path : arguments.recordings) {
    if (const Result<void> done = broadphase.run_recording(path); !done) return fail(done.error());
  }
  comparisons.scenes = broadphase.results();
  if (!arguments.out.empty()) {
    const Result<void> written = write_json(arguments.out, comparisons);
    if (!written) return fail(written.error());
  }
  return check(comparisons);
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  const auto arguments = carom::bench::parse(argc, argv);
  return arguments ? carom::bench::run(*arguments) : 2;
}
