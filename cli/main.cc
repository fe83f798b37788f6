#include "cli/process.h"

int main(int argc, char** argv) {
  return carom::cli::run_process(carom::cli::all_commands(), argc, argv);
}
