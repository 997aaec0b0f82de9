// What shoal-viz says to a person, on standard error.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/result.h"
#include "library/library.h"

namespace shoal::viz {

// Says what is wrong and returns the exit status that goes with it.
int report_error(const Error& error);

// A line that is no error.
void tell(const std::string& what);

// A line for each panorama that the library lacks, the first few of many.
void print_failed(const Library& library);

// A line for each table that is taken for native.
void print_frameless(const Library& library);

// A line where the library has panoramas of a degree below the one that was asked for.
void print_lesser_degrees(const Library& library, int degree);

// "WHAT 3/100" in a line that is redrawn; nothing where standard error is no terminal.
class Progress {
 public:
  explicit Progress(std::string_view what);
  ~Progress();  // clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::size_t done, std::size_t count);

 private:
  std::string_view what_;
  bool on_terminal_;
};

}  // namespace shoal::viz
