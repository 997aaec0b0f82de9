#include "kernels/targets.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace shoal::kernels {
namespace {

std::string upper(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::toupper(c); });
  return result;
}

std::vector<std::int64_t> runnable_targets() {
  static const std::int64_t supported = hwy::SupportedTargets();
  std::vector<std::int64_t> targets;
  // Highway gives better targets lower bits.
  for (int shift = 0; shift < 63; ++shift) {
    const std::int64_t bit = std::int64_t{1} << shift;
    if (HWY_TARGETS & supported & bit) targets.push_back(bit);
  }
  return targets;
}

}  // namespace

std::vector<std::string> available_targets() {
  std::vector<std::string> names;
  for (const std::int64_t target : runnable_targets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

std::string active_target() {
  const auto targets = runnable_targets();
  const std::int64_t enabled = hwy::SupportedTargets();
  const auto active = std::ranges::find_if(targets, [&](std::int64_t t) { return enabled & t; });
  return hwy::TargetName(active == targets.end() ? HWY_STATIC_TARGET : *active);
}

Status force_target(std::string_view name) {
  runnable_targets();  // remembers what the processor supports before the choice narrows it
  for (const std::int64_t target : runnable_targets()) {
    if (upper(name) != upper(hwy::TargetName(target))) continue;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    return {};
  }
  std::string known;
  for (const auto& target : available_targets()) known += (known.empty() ? "" : ", ") + target;
  return Error{ErrorCode::usage, "no SIMD target \"" + std::string(name) + "\" on this machine", "",
               "there are: " + known};
}

}  // namespace shoal::kernels
