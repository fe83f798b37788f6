// Numbers with a given count of decimal digits.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace carom::oracle {

template <unsigned kDigits>
using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<kDigits>,
                                             boost::multiprecision::et_off>;

}  // namespace carom::oracle
