#include "cli/support/options.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <system_error>

#include "cli/support/command_line.h"
#include "cli/support/number_text.h"
#include "io/printable.h"

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

bool names_file(const NamedFile& file) {
  return !file.name.empty() && !(file.option == "--json" && file.name == "-");
}

Error unknown(const std::string& what, const std::string& text, const std::string& available) {
  return {"unknown " + what + " " + io::quoted_name(text) + " (there are: " + available + ")"};
}

// All in the order of their enum.
constexpr const char* kTiers[] = {"fast", "standard", "certified", "exact"};
constexpr const char* kDetections[] = {"discrete", "swept", "continuous", "automatic"};

// Returns no set for "auto".
Result<std::optional<Isa>> parse_isa(const std::string& name) {
  std::optional<Isa> isa;
  if (name == "auto") return isa;
  isa = isa_from_name(name);
  if (!isa) return unknown("ISA", name, "auto, scalar, sse4, avx2, avx512, neon");
  std::vector<Isa> usable = usable_isas();
  if (std::find(usable.begin(), usable.end(), *isa) == usable.end()) {
    return Error{"ISA " + io::quoted_name(name) +
                 " cannot be used here: this build or this machine lacks it " +
                 "(usable: " + join_names(usable) + ")"};
  }
  return isa;
}

}  // namespace

void add_engine_options(Command& command, EngineOptions& options) {
  add_threads_option(command, options.threads);
  command.add_option("--isa", options.isa, "auto, scalar, sse4, avx2, avx512 or neon")
      .show_default();
}

void add_tier_options(Command& command, TierOptions& options) {
  command.add_option("--tier", options.tier, "fast, standard, certified or exact").show_default();
  command
      .add_option("--tolerance", options.tolerance,
                  "Metres by which results may be wrong at most; 0: the standard tier")
      .show_default();
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

Result<void> check_metres(const std::string& option, double metres) {
  if (metres >= 0 && metres <= std::numeric_limits<float>::max()) return {};
  return Error{option + number(" %g", metres) + ": not a number of metres from 0 to 3.4e38"};
}

Result<size_t> find_name(const std::string& what, const std::string& text,
                         std::span<const char* const> names) {
  std::string available;
  for (size_t i = 0; i < names.size(); ++i) {
    if (text == names[i]) return i;
    available += (i == 0 ? "" : ", ") + std::string(names[i]);
  }
  return unknown(what, text, available);
}

Result<Accuracy> parse_accuracy(const TierOptions& options) {
  const Result<size_t> tier = find_name("tier", options.tier, kTiers);
  if (!tier) return tier.error();
  Accuracy accuracy{.tier = static_cast<Tier>(*tier)};
  const Result<void> checked = check_metres("--tolerance", options.tolerance);
  if (!checked) return checked.error();
  accuracy.tolerance = static_cast<float>(options.tolerance);
  if (accuracy.tolerance > 0 && has_proofs(accuracy.tier)) {
    return Error{"--tolerance " + shortest(accuracy.tolerance) + ": not with --tier " +
                 options.tier + ", whose decisions are proven"};
  }
  return accuracy;
}

const char* name_of(Tier tier) { return kTiers[static_cast<size_t>(tier)]; }

std::string describe(const Accuracy& accuracy) {
  const std::string tier = name_of(accuracy.tier);
  return accuracy.tolerance > 0 ? tier + number(", within %g m", accuracy.tolerance) : tier;
}

const char* name_of(Detection detection) { return kDetections[static_cast<size_t>(detection)]; }

Result<Detection> parse_detection(const std::string& text) {
  const Result<size_t> detection = find_name("detection", text, kDetections);
  return detection ? Result<Detection>(static_cast<Detection>(*detection)) : detection.error();
}

Result<Detail> parse_detail(const std::string& text, std::span<const NamedDetail> known) {
  constexpr std::array kOfPairs = {"distance"sv, "toi"sv};
  std::string names;
  for (const NamedDetail& entry : known) {
    if (text == entry.name) return entry.detail;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  if (contains(kOfPairs, text)) {
    return Error{"detail " + io::quoted_name(text) + " is for files of pairs only (carom pairs)"};
  }
  return unknown("detail", text, names);
}

Result<ForcedIsa> ForcedIsa::create(const std::string& name) {
  Result<std::optional<Isa>> isa = parse_isa(name);
  if (!isa) return isa.error();
  return ForcedIsa(*isa && force_isa(**isa));
}

Result<void> check_apart(std::span<const NamedFile> files) {
  for (size_t i = 0; i < files.size(); ++i) {
    for (const NamedFile& other : files.subspan(i + 1)) {
      if (!names_file(files[i]) || !names_file(other)) continue;
      if (canonical(files[i].name) != canonical(other.name)) continue;
      return Error{files[i].option + " and " + other.option + " name the same file"};
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
