// The program `shoal`, which projects and shrinks panoramas for the viewer.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace shoal::viz {

// `shoal` beside this program, in its place in the build tree, or in PATH.
// Error: not_found.
[[nodiscard]] Result<std::filesystem::path> find_shoal();

// How a program ended, and what it said.
struct Finished {
  int exit_status = 0;  // 128 + signal where one ended it
  std::string out;
  std::string err;
};

// Runs a program to its end, with nothing to read. Errors: unreadable (it cannot be started).
[[nodiscard]] Result<Finished> run_program(const std::filesystem::path& program,
                                           const std::vector<std::string>& arguments);

// Cuts `texts` into runs [begin, end) that each fit onto a command line.
struct Range {
  std::size_t begin = 0;
  std::size_t end = 0;
};
[[nodiscard]] std::vector<Range> command_line_batches(std::span<const std::string> texts);

}  // namespace shoal::viz
