// Which candidates (a: index of the query, b: index of the body) the filter of a query keeps.
#pragma once

#include <vector>

#include "carom/queries/query_options.h"
#include "carom/results/pair.h"

namespace carom {

// By all rules but the predicate.
bool keeps(const QueryFilter& filter, Pair candidate);

// Drops the candidates that the predicate, if there is one, does not keep.
void ask_predicate(const QueryFilter& filter, std::vector<Pair>& candidates);

}  // namespace carom
