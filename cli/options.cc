#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <system_error>

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

Error not_yet(const std::string& what, const std::string& text, const std::string& available) {
  return {what + " '" + text + "' does not exist in this version (there are: " + available + ")"};
}

Error unknown(const std::string& what, const std::string& text, const std::string& available) {
  return {"unknown " + what + " '" + text + "' (there are: " + available + ")"};
}

// None for "auto".
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

void add_engine_options(CLI::App& command, EngineOptions& options) {
  add_threads_option(command, options.threads);
  command.add_option("--isa", options.isa, "auto, scalar, sse4, avx2, avx512 or neon")
      ->capture_default_str();
  command.add_option("--tier", options.tier, "standard")->capture_default_str();
}

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to use")->capture_default_str();
}

void add_json_option(CLI::App& command, std::string& json) {
  command.add_option("--json", json, "Write the results as JSON to this file; -: standard output")
      ->check(file_name());
}

Result<void> check_threads(int threads) {
  if (threads >= 1 && threads <= kMaxThreads) return {};
  return Error{"--threads " + std::to_string(threads) + ": not a number from 1 to " +
               std::to_string(kMaxThreads)};
}

Result<void> check_tier(const std::string& tier) {
  constexpr std::array kPlanned = {"fast"sv, "certified"sv, "exact"sv};
  if (tier == "standard") return {};
  return contains(kPlanned, tier) ? not_yet("tier", tier, "standard")
                                  : unknown("tier", tier, "standard");
}

Result<void> check_margin(double margin) {
  if (margin >= 0 && margin <= std::numeric_limits<float>::max()) return {};
  char text[32];
  std::snprintf(text, sizeof text, "%g", margin);
  return Error{"--margin " + std::string(text) + ": not a number of metres from 0 to 3.4e38"};
}

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

Result<Detail> parse_detail(const std::string& text, std::span<const NamedDetail> known) {
  constexpr std::array kPlanned = {"toi"sv};
  std::string names;
  for (const NamedDetail& entry : known) {
    if (text == entry.name) return entry.detail;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  return contains(kPlanned, text) ? not_yet("detail", text, names) : unknown("detail", text, names);
}

Result<ForcedIsa> ForcedIsa::create(const std::string& name) {
  Result<std::optional<Isa>> isa = parse_isa(name);
  if (!isa) return isa.error();
  return ForcedIsa(*isa && force_isa(**isa));
}

const CLI::Validator& file_name() {
  static const CLI::Validator validator(
      [](const std::string& name) {
        return name.empty() ? std::string("the name of the file is empty") : std::string();
      },
      "");
  return validator;
}

Result<void> check_apart(const std::string& json, const std::string& option,
                         const std::string& output) {
  if (json.empty() || json == "-" || canonical(json) != canonical(output)) return {};
  return Error{"--json and " + option + " name the same file"};
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
