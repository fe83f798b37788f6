#include "cli/run/world_options.h"

#include <nlohmann/json.hpp>

#include "cli/run/run_report.h"
#include "cli/support/command_line.h"
#include "cli/support/number_text.h"
#include "cli/support/options.h"
#include "cli/support/table.h"

namespace carom::cli {

// A setting, or a few that depend on each other: all that the program knows of it. A new setting is
// a class here and a line in WorldOptions::WorldOptions().
class WorldOption {
 public:
  virtual ~WorldOption() = default;

  virtual void add_to(Command& command) = 0;
  // Checks what the command line says and sets it.
  virtual Result<void> read(RunSettings& settings) const = 0;
  // The options that choose these settings, a blank before each; empty for the defaults.
  virtual std::string text_of(const RunSettings& settings) const = 0;

  // Most settings have a key, few a row.
  virtual void add_json(const RunReport& /*report*/, nlohmann::ordered_json& /*json*/) const {}
  virtual void add_rows(const RunReport& /*report*/, Table& /*table*/) const {}
};

namespace {

using Json = nlohmann::ordered_json;

constexpr NamedDetail kDetails[] = {{"pairs", Detail::pairs},
                                    {"overlap", Detail::overlap},
                                    {"contact", Detail::contact},
                                    {"manifold", Detail::manifold},
                                    {"regions", Detail::regions}};

class AccuracyOption : public WorldOption {
 public:
  void add_to(Command& command) override { add_tier_options(command, options_); }

  Result<void> read(RunSettings& settings) const override {
    const Result<Accuracy> accuracy = parse_accuracy(options_);
    if (!accuracy) return accuracy.error();
    settings.world.accuracy = *accuracy;
    return {};
  }

  std::string text_of(const RunSettings& settings) const override {
    const Accuracy& accuracy = settings.world.accuracy;
    std::string text;
    if (accuracy.tier != Tier::standard) text = std::string(" --tier ") + name_of(accuracy.tier);
    const float metres = accuracy.tolerance;
    return metres > 0 ? text + " --tolerance " + shortest(metres) : text;
  }

  void add_json(const RunReport& report, Json& json) const override {
    const Accuracy& accuracy = report.settings.world.accuracy;
    json["tier"] = name_of(accuracy.tier);
    if (accuracy.tolerance > 0) json["tolerance"] = accuracy.tolerance;
  }

  void add_rows(const RunReport& report, Table& table) const override {
    const Accuracy& accuracy = report.settings.world.accuracy;
    const std::string text = describe(accuracy);
    if (text != name_of(Tier::standard)) table.add({"tier", text});
  }

 private:
  TierOptions options_;
};

// The row of the broadphase names it.
class DetailOption : public WorldOption {
 public:
  void add_to(Command& command) override {
    command.add_option("--detail", name_, "pairs, overlap, contact, manifold or regions")
        .show_default();
  }

  Result<void> read(RunSettings& settings) const override {
    const Result<Detail> detail = parse_detail(name_, kDetails);
    if (!detail) return detail.error();
    settings.world.detail = *detail;
    return {};
  }

  std::string text_of(const RunSettings& settings) const override {
    const Detail detail = settings.world.detail;
    return detail == Detail::contact ? "" : std::string(" --detail ") + name_of(detail);
  }

  void add_json(const RunReport& report, Json& json) const override {
    json["detail"] = name_of(report.settings.world.detail);
  }

 private:
  std::string name_ = "contact";
};

// A setting of bodies: all dynamic ones get it. The row of the bodies looked after
// (run_report.cc) names it.
class DetectionOption : public WorldOption {
 public:
  void add_to(Command& command) override {
    command
        .add_option("--detection", name_,
                    "How dynamic bodies are looked after between frames: discrete, swept, "
                    "continuous or automatic")
        .show_default();
  }

  Result<void> read(RunSettings& settings) const override {
    const Result<Detection> detection = parse_detection(name_);
    if (!detection) return detection.error();
    settings.detection = *detection;
    return {};
  }

  std::string text_of(const RunSettings& settings) const override {
    const Detection detection = settings.detection;
    return detection == Detection::discrete ? ""
                                            : std::string(" --detection ") + name_of(detection);
  }

  void add_json(const RunReport& report, Json& json) const override {
    json["detection"] = name_of(report.settings.detection);
  }

 private:
  std::string name_ = "discrete";
};

class BroadphaseOption : public WorldOption {
 public:
  void add_to(Command& command) override {
    command.add_option("--broadphase", name_, "auto, grid, sweep or brute").show_default();
  }

  Result<void> read(RunSettings& settings) const override {
    std::vector<const char*> names;
    for (const BroadphaseMethod method : kMethods) names.push_back(name(method));
    const Result<size_t> index = find_name("broadphase", name_, names);
    if (!index) return index.error();
    settings.world.broadphase = kMethods[*index];
    return {};
  }

  std::string text_of(const RunSettings& settings) const override {
    const BroadphaseMethod method = settings.world.broadphase;
    if (method == BroadphaseMethod::automatic) return "";
    return std::string(" --broadphase ") + name(method);
  }

  // The method that ran, never "auto".
  void add_json(const RunReport& report, Json& json) const override {
    json["broadphase"] = name(report.record.search.method);
    json["broadphase_reason"] = report.record.search.reason;
  }

  void add_rows(const RunReport& report, Table& table) const override {
    const PairSearch& search = report.record.search;
    table.add({"detail, broadphase", std::string(name_of(report.settings.world.detail)) + ", " +
                                         name(search.method) + " (" + search.reason + ")"});
  }

 private:
  static constexpr BroadphaseMethod kMethods[] = {BroadphaseMethod::automatic,
                                                  BroadphaseMethod::brute, BroadphaseMethod::sweep,
                                                  BroadphaseMethod::grid};
  std::string name_ = "auto";
};

class PairOrderOption : public WorldOption {
 public:
  void add_to(Command& command) override {
    command.add_option("--pair-order", name_, "sorted, or any, which saves sorting").show_default();
  }

  // After the detail.
  Result<void> read(RunSettings& settings) const override {
    const Result<size_t> index = find_name("pair order", name_, kNames);
    if (!index) return index.error();
    settings.world.pair_order = static_cast<PairOrder>(*index);
    if (settings.world.pair_order == PairOrder::any && settings.world.detail != Detail::pairs) {
      return Error{"--pair-order any needs --detail pairs"};
    }
    return {};
  }

  std::string text_of(const RunSettings& settings) const override {
    return settings.world.pair_order == PairOrder::any ? " --pair-order any" : "";
  }

  void add_json(const RunReport& report, Json& json) const override {
    json["pair_order"] = kNames[static_cast<size_t>(report.settings.world.pair_order)];
  }

 private:
  static constexpr std::array kNames = {"sorted", "any"};
  std::string name_ = "sorted";
};

class MarginOption : public WorldOption {
 public:
  void add_to(Command& command) override {
    command.add_option("--margin", metres_, "Metres to fatten bounds by; pairs are kept longer")
        .show_default();
  }

  Result<void> read(RunSettings& settings) const override {
    if (Result<void> metres = check_metres("--margin", metres_); !metres) return metres;
    settings.world.margin = static_cast<float>(metres_);
    return {};
  }

  std::string text_of(const RunSettings& settings) const override {
    const float margin = settings.world.margin;
    return margin > 0 ? " --margin " + shortest(margin) : "";
  }

  void add_json(const RunReport& report, Json& json) const override {
    json["margin"] = report.settings.world.margin;
  }

 private:
  double metres_ = 0;
};

class ContactDistanceOption : public WorldOption {
 public:
  void add_to(Command& command) override {
    command
        .add_option("--contact-distance", metres_,
                    "Metres from which pairs have contacts before they touch")
        .show_default();
  }

  Result<void> read(RunSettings& settings) const override {
    if (Result<void> metres = check_metres("--contact-distance", metres_); !metres) return metres;
    settings.world.contact_distance = static_cast<float>(metres_);
    return {};
  }

  std::string text_of(const RunSettings& settings) const override {
    const float distance = settings.world.contact_distance;
    return distance > 0 ? " --contact-distance " + shortest(distance) : "";
  }

  void add_json(const RunReport& report, Json& json) const override {
    json["contact_distance"] = report.settings.world.contact_distance;
  }

 private:
  double metres_ = 0;
};

class DopBoundsOption : public WorldOption {
 public:
  void add_to(Command& command) override {
    command
        .add_option("--dop-bounds", directions_,
                    "Drop pairs whose k-DOPs of 6, 14, 18 or 26 directions are apart; 0: none")
        .show_default();
  }

  Result<void> read(RunSettings& settings) const override {
    if (directions_ == 0) return {};
    for (const DopKind kind : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
      if (directions_ == static_cast<int>(kind)) settings.world.dop_bounds = kind;
    }
    if (settings.world.dop_bounds) return {};
    return Error{"--dop-bounds " + std::to_string(directions_) +
                 ": there are k-DOPs of 6, 14, 18 and 26 directions, and 0 for none"};
  }

  std::string text_of(const RunSettings& settings) const override {
    const int directions = directions_of(settings);
    return directions > 0 ? " --dop-bounds " + std::to_string(directions) : "";
  }

  void add_json(const RunReport& report, Json& json) const override {
    json["dop_bounds"] = directions_of(report.settings);
  }

 private:
  // 0: none.
  static int directions_of(const RunSettings& settings) {
    const std::optional<DopKind> kind = settings.world.dop_bounds;
    return kind ? static_cast<int>(*kind) : 0;
  }

  int directions_ = 0;
};

class CacheOption : public WorldOption {
 public:
  void add_to(Command& command) override {
    command.add_flag("--no-cache", off_,
                     "Test every pair anew and drop the sort order between frames");
  }

  Result<void> read(RunSettings& settings) const override {
    settings.world.carry_results = !off_;
    return {};
  }

  std::string text_of(const RunSettings& settings) const override {
    return settings.world.carry_results ? "" : " --no-cache";
  }

 private:
  bool off_ = false;
};

}  // namespace

WorldOptions::WorldOptions() {
  list_.push_back(std::make_unique<AccuracyOption>());
  list_.push_back(std::make_unique<DetailOption>());
  list_.push_back(std::make_unique<DetectionOption>());
  list_.push_back(std::make_unique<BroadphaseOption>());
  list_.push_back(std::make_unique<PairOrderOption>());
  list_.push_back(std::make_unique<MarginOption>());
  list_.push_back(std::make_unique<ContactDistanceOption>());
  list_.push_back(std::make_unique<DopBoundsOption>());
  list_.push_back(std::make_unique<CacheOption>());
}

WorldOptions::~WorldOptions() = default;

void WorldOptions::add_to(Command& command) {
  for (const auto& option : list_) option->add_to(command);
}

Result<RunSettings> WorldOptions::read() const {
  RunSettings settings;
  for (const auto& option : list_) {
    if (Result<void> read = option->read(settings); !read) return read.error();
  }
  return settings;
}

void WorldOptions::add_json(const RunReport& report, Json& json) const {
  for (const auto& option : list_) option->add_json(report, json);
}

void WorldOptions::add_rows(const RunReport& report, Table& table) const {
  for (const auto& option : list_) option->add_rows(report, table);
}

std::string WorldOptions::text_of(const RunSettings& settings) const {
  std::string text;
  for (const auto& option : list_) text += option->text_of(settings);
  return text;
}

const char* name_of(Detail detail) { return kDetails[static_cast<size_t>(detail)].name; }

}  // namespace carom::cli
