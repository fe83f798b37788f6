// Numbers and pairs as text.
#pragma once

#include <string>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

// One number as printf() writes it.
std::string text(const char* format, double value);

// All numbers of a pair in hexadecimal, to copy into a test.
std::string describe(const ConvexPair& pair, PositionType positions);

}  // namespace carom::accuracy
