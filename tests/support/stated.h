// Makes the stored bodies that the proofs of single pairs take.
#pragma once

#include "carom/shapes/body.h"
#include "narrowphase/batch/stated_body.h"

namespace carom::test {

StatedBody stated_body(const Shape& shape, const Pose& pose);

}  // namespace carom::test
