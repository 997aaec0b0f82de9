// Runs a function of GLSL on directions, in a compute shader, without any window or display.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace shoal::test {

struct ShaderRun {
  std::vector<glm::vec3> values;  // one a direction; none where the shader does not compile
  std::string log;                // what the compiler says then
  std::string error;              // why there is nothing to run it on; then it is nobody's fault
};

// `source` defines vec3 `function`(vec3).
ShaderRun run_on_directions(const std::string& source, const std::string& function,
                            const std::vector<glm::dvec3>& directions);

}  // namespace shoal::test
