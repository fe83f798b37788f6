// The HTML page of a document of measurements, with the data inside.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace carom::accuracy {

std::string page_with(const nlohmann::ordered_json& json);

}  // namespace carom::accuracy
