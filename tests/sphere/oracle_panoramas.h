// Coefficients of real panoramas to degree 8, from the table that an independent program made of
// them; it stands beside the panoramas.
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "../support/test_data.h"
#include "sphere/coefficients.h"

namespace shoal::test {

inline constexpr const char* kOracleTable = "../oracle/coefficients.csv";

// Radiance by panorama, as the texel quadrature has it.
inline std::map<std::string, Coefficients> oracle_panoramas() {
  std::ifstream file(data_folder() / kOracleTable);
  std::map<std::string, Coefficients> panoramas;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string name, quadrature, l, m, value;
    std::getline(fields, name, ',');
    std::getline(fields, quadrature, ',');
    if (quadrature != "texel") continue;
    std::getline(fields, l, ',');
    std::getline(fields, m, ',');
    Coefficients& panorama = panoramas.try_emplace(name, 8).first->second;
    for (auto& channel : panorama.channels) {
      std::getline(fields, value, ',');
      channel[coefficient_index(std::stoi(l), std::stoi(m))] = std::stod(value);
    }
  }
  return panoramas;
}

}  // namespace shoal::test
