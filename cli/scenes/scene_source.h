// Opens scenes named on the command line: a file or a generator.
#pragma once

#include <memory>
#include <string>

#include "carom/base/result.h"
#include "io/scene.h"

namespace carom::cli {

// Opens the file of that name if it exists; otherwise a text such as "brownian:n=1000" names a
// generator.
Result<std::unique_ptr<io::SceneReader>> open_source(const std::string& text);

// Whether open_source() would read the text as a generator.
bool names_generator(const std::string& text);

}  // namespace carom::cli
