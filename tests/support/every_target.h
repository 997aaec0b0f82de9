// Runs a test body once a SIMD target of this machine.
#pragma once

#include <gtest/gtest.h>

#include "kernels/targets.h"

namespace shoal::test {

// Puts the target back that was active, also when an assertion leaves early.
class TargetGuard {
 public:
  TargetGuard() : name_(kernels::active_target()) {}
  ~TargetGuard() { static_cast<void>(kernels::force_target(name_)); }
  TargetGuard(const TargetGuard&) = delete;
  TargetGuard& operator=(const TargetGuard&) = delete;

 private:
  std::string name_;
};

template <typename Body>
void for_every_target(const Body& body) {
  const TargetGuard guard;
  for (const std::string& target : kernels::available_targets()) {
    SCOPED_TRACE("SIMD target " + target);
    ASSERT_TRUE(kernels::force_target(target));
    body();
  }
}

}  // namespace shoal::test
