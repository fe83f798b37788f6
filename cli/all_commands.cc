#include "cli/commands.h"

namespace carom::cli {

std::span<const AddCommand> all_commands() {
  static constexpr AddCommand kAll[] = {
      add_run_command,    add_pairs_command,    add_verify_command,
      add_advise_command, add_accuracy_command, add_tunnelling_command,
      add_check_command,  add_generate_command, add_info_command,
  };
  return kAll;
}

}  // namespace carom::cli
