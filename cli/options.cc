#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

namespace carom::cli {
namespace {

using std::string_view_literals::operator""sv;

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Error not_yet(const std::string& what, const std::string& text, const std::string& available) {
  return {what + " '" + text + "' does not exist in this version (there are: " + available + ")"};
}

Error unknown(const std::string& what, const std::string& text, const std::string& available) {
  return {"unknown " + what + " '" + text + "' (there are: " + available + ")"};
}

}  // namespace

void add_engine_options(CLI::App& command, EngineOptions& options) {
  add_threads_option(command, options.threads);
  command.add_option("--isa", options.isa, "auto, scalar, sse4, avx2, avx512 or neon");
  command.add_option("--tier", options.tier, "standard");
}

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to use");
}

void add_json_option(CLI::App& command, std::string& json) {
  command.add_option("--json", json, "Write the results as JSON to this file; -: standard output");
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

Result<BroadphaseMethod> parse_broadphase(const std::string& text) {
  std::string names;
  for (auto method :
       {BroadphaseMethod::automatic, BroadphaseMethod::brute, BroadphaseMethod::sweep}) {
    if (text == name(method)) return method;
    names += (names.empty() ? "" : ", ") + std::string(name(method));
  }
  return unknown("broadphase", text, names);
}

Result<Detail> parse_detail(const std::string& text, std::span<const NamedDetail> known) {
  constexpr std::array kPlanned = {"manifold"sv, "toi"sv};
  std::string names;
  for (const NamedDetail& entry : known) {
    if (text == entry.name) return entry.detail;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  return contains(kPlanned, text) ? not_yet("detail", text, names) : unknown("detail", text, names);
}

Result<ForcedIsa> ForcedIsa::create(const std::string& name) {
  if (name == "auto") return ForcedIsa(false);
  std::optional<Isa> isa = isa_from_name(name);
  if (!isa) return unknown("ISA", name, "auto, scalar, sse4, avx2, avx512, neon");
  if (!force_isa(*isa)) {
    return Error{"ISA '" + name + "' cannot be used here: this build or this machine lacks it " +
                 "(usable: " + join_names(usable_isas()) + ")"};
  }
  return ForcedIsa(true);
}

std::string join_names(std::span<const Isa> isas) {
  std::string names;
  for (Isa isa : isas) names += (names.empty() ? "" : ", ") + std::string(name(isa));
  return names;
}

}  // namespace carom::cli
