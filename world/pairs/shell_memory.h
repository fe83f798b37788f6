// Keeps the shells of hulls that overlap (narrowphase/hulls/shell.h), which prove the depths of the
// next step within the tolerance. Where they seldom do, it keeps none for a while.
#pragma once

#include <cstdint>

#include "base/raw_vector.h"
#include "narrowphase/blocks/kept_shells.h"
#include "world/pairs/pauses.h"

namespace carom {

class ShellMemory {
 public:
  // Call it once a step that could use shells. Whether the step is to use them.
  bool starts_step() { return pauses_.starts_step(); }

  // Makes room for the shells of this step.
  ShellLists& prepare(size_t tested);

  // Makes these the shells of the last step, after the tests. Returns how many of the last step's
  // proved a depth in this one.
  size_t keep();

  // The step has none.
  void forget();

  void give_back();
  size_t bytes() const;

 private:
  RawVector<Shell> last_, now_;
  ShellLists lists_;
  bool is_first_ = true;  // of the steps in a row that use shells: it makes all of them
  Pauses pauses_{8, 128};
};

}  // namespace carom
