// Runs Python, for tests that let an independent reader look at what shoal wrote.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "core/atomic_file.h"

namespace shoal::test {

struct PythonRun {
  int status = -1;
  std::string output;  // stdout and stderr
};

inline PythonRun run_shell(const std::string& command) {
  PythonRun run;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return run;
  char buffer[4096];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe)) {
    run.output.append(buffer, count);
  }
  const int status = ::pclose(pipe);
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

// A Python 3 that has `module`, or nothing.
inline std::optional<std::string> python_with(const std::string& module) {
  for (const std::string python : {"python3", "/usr/bin/python3"}) {
    if (run_shell(python + " -c 'import " + module + "'").status == 0) return python;
  }
  return std::nullopt;
}

// Runs `script`, kept at `folder`/script.py, in `folder`.
inline PythonRun run_python(const std::string& python, const std::filesystem::path& folder,
                            const std::string& script) {
  const auto written = write_file_atomically(folder / "script.py", script);
  if (!written) return {-1, written.error().text()};
  return run_shell("cd '" + folder.string() + "' && " + python + " script.py");
}

}  // namespace shoal::test

// Declares `python`, or skips the test where no Python has `module`.
#define SHOAL_REQUIRE_PYTHON(python, module)                                      \
  const auto found_##python = shoal::test::python_with(module);                   \
  if (!found_##python) GTEST_SKIP() << "no python3 with the module " << (module); \
  const std::string& python = *found_##python
