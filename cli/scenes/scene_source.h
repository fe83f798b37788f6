// A scene as the command line names it: a file or a generator.
#pragma once

#include <memory>
#include <string>

#include "carom/base/result.h"
#include "io/scene.h"

namespace carom::cli {

// A file of that name comes first; otherwise a text such as "brownian:n=1000" is a generator.
Result<std::unique_ptr<io::SceneReader>> open_source(const std::string& text);

// Whether open_source() would take the text for a generator.
bool names_generator(const std::string& text);

}  // namespace carom::cli
