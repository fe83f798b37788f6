// Height fields of MJCF: assets whose samples stand in the model or in a file of MuJoCo's format.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "io/models/mjcf_settings.h"
#include "io/models/model.h"

namespace carom::io {

class MjcfHeightFields {
 public:
  // Notes a height field of an asset section; it is read when a geom needs it.
  void add(const Xml& element, FirstError& errors);
  // The height field of this name for a geom; nullptr on failure.
  std::shared_ptr<const ModelHeights> get(const std::string& name,
                                          const std::filesystem::path& folder,
                                          const MjcfSettings& settings, const Xml& geom,
                                          FirstError& errors);

 private:
  struct Asset {
    const Xml* element;
    std::shared_ptr<const ModelHeights> heights;  // once they are read
  };
  std::map<std::string, Asset> assets_;
};

}  // namespace carom::io
