#include "accuracy/scenes/fidelity_json.h"

#include <nlohmann/json.hpp>

namespace carom::accuracy {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const FidelityEntry& entry) {
  return {{"scene", entry.scene},
          {"setting", entry.setting},
          {"pairs", entry.pairs},
          {"lost", entry.lost},
          {"gained", entry.gained},
          {"contact_error_worst", entry.contact_error_worst},
          {"contact_error_p99", entry.contact_error_p99},
          {"events_moved", entry.events_moved},
          {"frame_ms", entry.frame_ms},
          {"frame_ms_standard", entry.frame_ms_standard}};
}

Json to_json(const ReuseEntry& entry) {
  return {{"scene", entry.scene},
          {"tolerance", entry.tolerance},
          {"frame_ms", entry.frame_ms},
          {"frame_ms_standard", entry.frame_ms_standard},
          {"error_bound", entry.error_bound},
          {"error_worst", entry.error_worst},
          {"lost", entry.lost},
          {"gained", entry.gained},
          {"pairs", entry.pairs}};
}

}  // namespace

Json to_json(const FidelityReport& report) {
  Json json = {{"fidelity", Json::array()}, {"reuse", Json::array()}};
  for (const FidelityEntry& entry : report.fidelity) json["fidelity"].push_back(to_json(entry));
  for (const ReuseEntry& entry : report.reuse) json["reuse"].push_back(to_json(entry));
  return json;
}

}  // namespace carom::accuracy
