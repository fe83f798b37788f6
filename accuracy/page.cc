#include "accuracy/page.h"

#include <nlohmann/json.hpp>

#include "accuracy/page_text.h"
#include "io/page.h"

namespace carom::accuracy {

std::string page_with(const nlohmann::ordered_json& json) {
  return io::fill_page(kPagePieces,
                       json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace carom::accuracy
