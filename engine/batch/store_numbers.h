// Several numbers in one column of the store, each with a blank behind it.
#pragma once

#include <string>
#include <vector>

namespace shoal {

// They read back as the same doubles.
[[nodiscard]] std::string joined(const std::vector<double>& values);

// Up to the first word that is no number.
[[nodiscard]] std::vector<double> split(const std::string& text);

}  // namespace shoal
