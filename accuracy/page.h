// The page that shows a document of measurements; its data is in it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace carom::accuracy {

std::string page_with(const nlohmann::ordered_json& json);

}  // namespace carom::accuracy
