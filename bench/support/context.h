// Machine, compiler, flags and commit, for the head of the report.
#pragma once

namespace carom::bench {

void add_context();

}  // namespace carom::bench
