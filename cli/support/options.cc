#include "cli/support/options.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <system_error>

#include "cli/support/command_line.h"

namespace carom::cli {
namespace {

using std::string_view_literals::operator""sv;

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::filesystem::path canonical(const std::string& path) {
  std::error_code error;
  std::filesystem::path absolute = std::filesystem::absolute(path, error);
  std::filesystem::path resolved = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute : resolved;
}

bool names_file(const OutputFile& output) {
  return !output.name.empty() && !(output.option == "--json" && output.name == "-");
}

Error unknown(const std::string& what, const std::string& text, const std::string& available) {
  return {"unknown " + what + " '" + text + "' (there are: " + available + ")"};
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

Result<void> check_metres(const std::string& option, double metres) {
  if (metres >= 0 && metres <= std::numeric_limits<float>::max()) return {};
  return Error{option + ' ' + short_number(metres) + ": not a number of metres from 0 to 3.4e38"};
}

struct NamedTier {
  std::string_view name;
  Tier tier;
};
constexpr NamedTier kTiers[] = {{"fast", Tier::fast},
                                {"standard", Tier::standard},
                                {"certified", Tier::certified},
                                {"exact", Tier::exact}};

std::string_view name_of(Tier tier) { return kTiers[static_cast<size_t>(tier)].name; }

Result<Tier> parse_tier(const std::string& text) {
  std::string names;
  for (const NamedTier& entry : kTiers) {
    if (text == entry.name) return entry.tier;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  return unknown("tier", text, names);
}

struct NamedKnob {
  std::string_view name;
  bool FastKnobs::*knob;
  KnobsOf of;
};
constexpr NamedKnob kKnobs[] = {{"single-precision", &FastKnobs::single_precision, KnobsOf::pairs},
                                {"faces-only", &FastKnobs::faces_only, KnobsOf::pairs},
                                {"proxy-spheres", &FastKnobs::proxy_spheres, KnobsOf::worlds}};

Result<void> set_knob(const std::string& name, KnobsOf served, FastKnobs& knobs) {
  std::string names;
  for (const NamedKnob& entry : kKnobs) {
    const bool is_served = entry.of == KnobsOf::pairs || served == KnobsOf::worlds;
    if (name == entry.name && !is_served) {
      return Error{"knob '" + name + "' is for scenes only (carom run)"};
    }
    if (name == entry.name) {
      knobs.*entry.knob = true;
      return {};
    }
    if (is_served) names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  return unknown("knob", name, names);
}

// An empty list sets no knob.
Result<void> parse_knobs(const std::string& list, KnobsOf served, FastKnobs& knobs) {
  if (list.empty()) return {};
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    Result<void> set = set_knob(list.substr(begin, end - begin), served, knobs);
    if (!set) return set;
    begin = end + 1;
  }
  return {};
}

Error needs_fast(const std::string& option, const std::string& tier) {
  return {option + " needs --tier fast, not " + tier};
}

// Returns no set for "auto".
Result<std::optional<Isa>> parse_isa(const std::string& name) {
  std::optional<Isa> isa;
  if (name == "auto") return isa;
  isa = isa_from_name(name);
  if (!isa) return unknown("ISA", name, "auto, scalar, sse4, avx2, avx512, neon");
  std::vector<Isa> usable = usable_isas();
  if (std::find(usable.begin(), usable.end(), *isa) == usable.end()) {
    return Error{"ISA '" + name + "' cannot be used here: this build or this machine lacks it " +
                 "(usable: " + join_names(usable) + ")"};
  }
  return isa;
}

}  // namespace

void add_engine_options(Command& command, EngineOptions& options) {
  add_threads_option(command, options.threads);
  command.add_option("--isa", options.isa, "auto, scalar, sse4, avx2, avx512 or neon")
      .show_default();
  command.add_option("--tier", options.tier, "fast, standard, certified or exact").show_default();
  command.add_option("--knobs", options.knobs,
                     "What the fast tier loosens, separated by commas; none if not given");
}

void add_threads_option(Command& command, int& threads) {
  command.add_option("--threads", threads, "Threads to use").show_default();
}

void add_json_option(Command& command, std::string& json) {
  command.add_option("--json", json, "Write the results as JSON to this file; -: standard output")
      .file_name();
}

Result<void> check_threads(int threads) {
  if (threads >= 1 && threads <= kMaxThreads) return {};
  return Error{"--threads " + std::to_string(threads) + ": not a number from 1 to " +
               std::to_string(kMaxThreads)};
}

Result<Accuracy> parse_accuracy(const EngineOptions& options, KnobsOf served) {
  Result<Tier> tier = parse_tier(options.tier);
  if (!tier) return tier.error();
  Accuracy accuracy{.tier = *tier, .knobs = {}};
  Result<void> parsed = parse_knobs(options.knobs, served, accuracy.knobs);
  if (!parsed) return parsed.error();
  parsed = check_metres("--motion-tolerance", options.motion_tolerance);
  if (!parsed) return parsed.error();
  accuracy.knobs.motion_tolerance = static_cast<float>(options.motion_tolerance);
  if (*tier == Tier::fast) return accuracy;
  if (!options.knobs.empty()) return needs_fast("--knobs", options.tier);
  if (options.motion_tolerance > 0) return needs_fast("--motion-tolerance", options.tier);
  return accuracy;
}

std::vector<std::string> names_of(const FastKnobs& knobs) {
  std::vector<std::string> names;
  for (const NamedKnob& entry : kKnobs) {
    if (knobs.*entry.knob) names.emplace_back(entry.name);
  }
  return names;
}

std::string describe(const Accuracy& accuracy) {
  std::string text(name_of(accuracy.tier));
  if (accuracy.tier != Tier::fast) return text;
  std::vector<std::string> parts = names_of(accuracy.knobs);
  if (accuracy.knobs.motion_tolerance > 0) {
    parts.push_back("motion tolerance " + short_number(accuracy.knobs.motion_tolerance) + " m");
  }
  for (size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? ": " : ", ") + parts[i];
  return text;
}

Result<void> check_margin(double margin) { return check_metres("--margin", margin); }

Result<std::optional<DopKind>> parse_dop_bounds(int directions) {
  std::optional<DopKind> kind;
  if (directions == 0) return kind;
  for (const DopKind known : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
    if (directions == static_cast<int>(known)) kind = known;
  }
  if (kind) return kind;
  return Error{"--dop-bounds " + std::to_string(directions) +
               ": there are k-DOPs of 6, 14, 18 and 26 directions, and 0 for none"};
}

Result<BroadphaseMethod> parse_broadphase(const std::string& text) {
  std::string names;
  for (auto method : {BroadphaseMethod::automatic, BroadphaseMethod::brute, BroadphaseMethod::sweep,
                      BroadphaseMethod::grid}) {
    if (text == name(method)) return method;
    names += (names.empty() ? "" : ", ") + std::string(name(method));
  }
  return unknown("broadphase", text, names);
}

const char* name_of(Detection detection) {
  constexpr const char* kNames[] = {"discrete", "swept", "continuous", "automatic"};
  return kNames[static_cast<size_t>(detection)];
}

Result<Detection> parse_detection(const std::string& text) {
  std::string names;
  for (auto detection :
       {Detection::discrete, Detection::swept, Detection::continuous, Detection::automatic}) {
    if (text == name_of(detection)) return detection;
    names += (names.empty() ? "" : ", ") + std::string(name_of(detection));
  }
  return unknown("detection", text, names);
}

Result<Detail> parse_detail(const std::string& text, std::span<const NamedDetail> known) {
  constexpr std::array kOfPairs = {"distance"sv, "toi"sv};
  std::string names;
  for (const NamedDetail& entry : known) {
    if (text == entry.name) return entry.detail;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  if (contains(kOfPairs, text)) {
    return Error{"detail '" + text + "' is for files of pairs only (carom pairs)"};
  }
  return unknown("detail", text, names);
}

Result<ForcedIsa> ForcedIsa::create(const std::string& name) {
  Result<std::optional<Isa>> isa = parse_isa(name);
  if (!isa) return isa.error();
  return ForcedIsa(*isa && force_isa(**isa));
}

Result<void> check_apart(std::span<const OutputFile> outputs) {
  for (size_t i = 0; i < outputs.size(); ++i) {
    for (const OutputFile& other : outputs.subspan(i + 1)) {
      if (!names_file(outputs[i]) || !names_file(other)) continue;
      if (canonical(outputs[i].name) != canonical(other.name)) continue;
      return Error{outputs[i].option + " and " + other.option + " name the same file"};
    }
  }
  return {};
}

Result<void> check_isa_variable() {
  const char* name = std::getenv("CAROM_ISA");
  if (name == nullptr || *name == '\0') return {};
  Result<std::optional<Isa>> isa = parse_isa(name);
  if (!isa) return Error{"environment variable CAROM_ISA: " + isa.error().message};
  return {};
}

std::string join_names(std::span<const Isa> isas) {
  std::string names;
  for (Isa isa : isas) names += (names.empty() ? "" : ", ") + std::string(name(isa));
  return names;
}

}  // namespace carom::cli
