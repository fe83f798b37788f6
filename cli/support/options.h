// Options that several commands share: their text and their meaning.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "carom/base/result.h"
#include "carom/results/contact.h"
#include "carom/results/tier.h"
#include "carom/shapes/body.h"
#include "carom/simd/isa.h"

namespace carom::cli {

class Command;

// How the program runs; results do not depend on it.
struct EngineOptions {
  std::string isa = "auto";
  int threads = 1;
};

struct TierOptions {
  std::string tier = "standard";
  double tolerance = 0;  // metres
};

void add_engine_options(Command& command, EngineOptions& options);
// Tier and tolerance, which scenes and pairs have.
void add_tier_options(Command& command, TierOptions& options);
void add_threads_option(Command& command, int& threads);
void add_json_option(Command& command, std::string& json);

inline constexpr int kMaxThreads = 1024;
Result<void> check_threads(int threads);

// Checks that the number of an option is finite and not negative.
Result<void> check_metres(const std::string& option, double metres);
// The index of `text` among the names that `what` may have.
Result<size_t> find_name(const std::string& what, const std::string& text,
                         std::span<const char* const> names);

// Parses tier and tolerance.
Result<Accuracy> parse_accuracy(const TierOptions& options);
// "fast", "standard", "certified", "exact".
const char* name_of(Tier tier);
// Readable text: "fast, within 0.01 m".
std::string describe(const Accuracy& accuracy);

// "discrete", "swept", "continuous", "automatic".
const char* name_of(Detection detection);
Result<Detection> parse_detection(const std::string& text);

struct NamedDetail {
  const char* name;
  Detail detail;
};
// Finds `text` among a command's details. Refuses a detail that only `carom pairs` has with its own
// message.
Result<Detail> parse_detail(const std::string& text, std::span<const NamedDetail> known);

struct NamedFile {
  std::string option;
  std::string name;  // empty: not given
};
// Refuses an input and outputs, or two outputs, that name the same file, however they are spelled.
// "-" of --json is not a file.
Result<void> check_apart(std::span<const NamedFile> files);

// Fails if CAROM_ISA is unusable; the library ignores that silently.
Result<void> check_isa_variable();

// Forces an instruction set for as long as it lives; "auto" forces none.
class ForcedIsa {
 public:
  static Result<ForcedIsa> create(const std::string& name);
  ForcedIsa(ForcedIsa&& other) noexcept : forced_(std::exchange(other.forced_, false)) {}
  ForcedIsa& operator=(ForcedIsa&&) = delete;
  ~ForcedIsa() {
    if (forced_) unforce_isa();
  }

 private:
  explicit ForcedIsa(bool forced) : forced_(forced) {}
  bool forced_;
};

// "scalar, sse4, avx2".
std::string join_names(std::span<const Isa> isas);

}  // namespace carom::cli
