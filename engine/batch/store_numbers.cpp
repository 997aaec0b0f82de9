#include "batch/store_numbers.h"

#include <fmt/format.h>

#include <cstdlib>

namespace shoal {

std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{:.17g} ", value);
  return text;
}

std::vector<double> split(const std::string& text) {
  std::vector<double> values;
  const char* at = text.c_str();
  for (char* end = nullptr;; at = end) {
    const double value = std::strtod(at, &end);
    if (end == at) return values;
    values.push_back(value);
  }
}

}  // namespace shoal
